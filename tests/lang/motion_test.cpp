// Interpolation of keyed transforms against closed forms.
#include "dspm/lang/motion.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "dspm/base/math/moments.h"

namespace dspm {
namespace {

using Kind = TransformOp::Kind;

void expect_near(const Matrix4& a, const Matrix4& b, double tolerance = 1e-12) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) EXPECT_NEAR(a.m[i][j], b.m[i][j], tolerance) << "row " << i << " column " << j;
}

TransformOp translate(double x, double y, double z) { return {Kind::translate, {x, y, z}}; }
TransformOp rotate(double degrees, double x, double y, double z) { return {Kind::rotate, {degrees, x, y, z}}; }
TransformOp scale(double x, double y, double z) { return {Kind::scale, {x, y, z}}; }
TransformOp matrix(const Matrix4& m) {
  TransformOp op{Kind::matrix, {}};
  for (std::size_t i = 0; i < 16; ++i) op.arguments[i] = m.m[i % 4][i / 4];
  return op;
}

Matrix4 between(std::vector<TransformOp> a, std::vector<TransformOp> b, double frames, double last,
                Ease ease = Ease::linear) {
  return KeyedTransform({{Moment(), ease, std::move(a)}, {Moment(last), Ease::linear, std::move(b)}})
      .at(Moment(frames));
}

TEST(KeyedTransform, FirstAndLastKeyHold) {
  const KeyedTransform keyed(
      {{Moment(3), Ease::linear, {translate(1, 0, 0)}}, {Moment(5), Ease::linear, {translate(2, 0, 0)}}});
  for (const double frames : {0., 2.5, 3.}) expect_near(keyed.at(Moment(frames)), Matrix4::translate(1, 0, 0), 0);
  expect_near(keyed.at(Moment(4)), Matrix4::translate(1.5, 0, 0), 0);
  for (const double frames : {5., 5.5, 6., 100.}) expect_near(keyed.at(Moment(frames)), Matrix4::translate(2, 0, 0), 0);
}

TEST(KeyedTransform, EqualKeysAreOneState) {
  const std::vector<TransformOp> turned{rotate(0.1, 0.3, 0.7, 0.11), translate(0.1, 0.7, 1.3)};
  const std::vector<TransformOp> stands[] = {
      turned, {matrix(turned[0].matrix())}, {TransformOp{Kind::look_at, {0.1, 1.3, -4.7, 0.3, 0.7, 0.1, 0, 1, 0}}}};
  for (const auto& stand : stands) {
    const Matrix4 first = between(stand, stand, 0, 24);
    for (int f = 1; f <= 24; ++f) EXPECT_EQ(between(stand, stand, f, 24), first);
  }
}

TEST(KeyedTransform, EqualSequencesGoArgumentByArgument) {
  for (int f = 0; f <= 16; ++f) {
    expect_near(between({rotate(0, 0, 1, 0)}, {rotate(360, 0, 1, 0)}, f, 16), Matrix4::rotate(22.5 * f, 0, 1, 0));
    const double t = f / 16.0;
    expect_near(
        between({translate(0, 0, 0), rotate(0, 1, 0, 0), scale(1, 1, 1)},
                {translate(1, 2, 3), rotate(-720, 1, 0, 0), scale(3, 2, 1)}, f, 16),
        Matrix4::translate(t, 2 * t, 3 * t) * Matrix4::rotate(-720 * t, 1, 0, 0) * Matrix4::scale(1 + 2 * t, 1 + t, 1));
  }
}

TEST(KeyedTransform, LookAtGoesArgumentByArgument) {
  const TransformOp a{Kind::look_at, {0, 0, -5, 0, 0, 0, 0, 1, 0}}, b{Kind::look_at, {0, 0, -9, 0, 0, 0, 0, 1, 0}};
  expect_near(between({a}, {b}, 1, 4), Matrix4::translate(0, 0, 6));
}

TEST(KeyedTransform, OthersAreDecomposed) {
  // 90 degrees apart: slerp's angle grows evenly; translation and scale are linear.
  const Matrix4 from = Matrix4::translate(1, 0, 0) * Matrix4::rotate(10, 1, 2, 3) * Matrix4::scale(1, 1, 2);
  const Matrix4 to = Matrix4::translate(3, 4, 0) * Matrix4::rotate(100, 1, 2, 3) * Matrix4::scale(3, 1, 1);
  for (int f = 0; f <= 9; ++f) {
    const double t = f / 9.0;
    const Matrix4 expected = Matrix4::translate(1 + 2 * t, 4 * t, 0) * Matrix4::rotate(10 + 90 * t, 1, 2, 3) *
                             Matrix4::scale(1 + 2 * t, 1, 2 - t);
    expect_near(between({matrix(from)}, {matrix(to)}, f, 9), expected);
    expect_near(between({translate(1, 0, 0), rotate(10, 1, 2, 3), scale(1, 1, 2)}, {matrix(to)}, f, 9), expected);
  }
}

TEST(KeyedTransform, DecompositionTakesTheShorterWay) {
  expect_near(between({rotate(0, 0, 0, 1)}, {rotate(270, 0, 0, 1), scale(1, 1, 1)}, 1, 3),
              Matrix4::rotate(-30, 0, 0, 1));
}

TEST(KeyedTransform, MirrorsStayMirrors) {
  const Matrix4 mirror = Matrix4::scale(-1, 1, 1);
  expect_near(between({matrix(mirror)}, {matrix(Matrix4::rotate(90, 1, 0, 0) * mirror)}, 1, 2),
              Matrix4::rotate(45, 1, 0, 0) * mirror);
}

// Of a rotation beyond 120 degrees the quaternion comes from the largest element of the diagonal.
TEST(KeyedTransform, LargeRotationsTurnAboutTheirAxis) {
  for (const auto& [x, y, z] : {std::array{1., 0.3, 0.5}, std::array{0.4, 1., -0.6}, std::array{-0.5, 0.3, 1.}})
    for (const double degrees : {125., 150., 175.})
      expect_near(between({matrix(Matrix4{})}, {matrix(Matrix4::rotate(degrees, x, y, z))}, 1, 4),
                  Matrix4::rotate(degrees / 4, x, y, z));
}

TEST(KeyedTransform, KeysAreMetExactlyAndRotationsStayRigid) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const Matrix4 a = Matrix4::translate(u(rng), u(rng), u(rng)) * Matrix4::rotate(400 * u(rng), u(rng), u(rng), 1);
    const Matrix4 b = Matrix4::translate(u(rng), u(rng), u(rng)) * Matrix4::rotate(400 * u(rng), u(rng), 1, u(rng));
    expect_near(between({matrix(a)}, {matrix(b)}, 0, 7), a, 0);
    expect_near(between({matrix(a)}, {matrix(b)}, 7, 7), b, 0);
    Matrix4 r = between({matrix(a)}, {matrix(b)}, 1 + i % 6, 7);
    for (std::size_t k = 0; k < 3; ++k) r.m[k][3] = 0;
    Matrix4 transposed;
    for (std::size_t k = 0; k < 16; ++k) transposed.m[k / 4][k % 4] = r.m[k % 4][k / 4];
    expect_near(r * transposed, Matrix4{});
  }
}

TEST(KeyedTransform, IsEased) {
  const auto x = [](Ease ease, double f) {
    return between({translate(0, 0, 0)}, {translate(1, 0, 0)}, f, 4, ease).m[0][3];
  };
  EXPECT_DOUBLE_EQ(x(Ease::linear, 1), .25);
  EXPECT_DOUBLE_EQ(x(Ease::smooth, 1), 3 * .0625 - 2 * .015625);
  EXPECT_DOUBLE_EQ(x(Ease::smooth, 2), .5);
  EXPECT_DOUBLE_EQ(x(Ease::step, 3), 0);
  EXPECT_DOUBLE_EQ(x(Ease::step, 4), 1);
}

TEST(KeyedTransform, HasTimesBetweenWholeFrames) {
  const KeyedTransform keyed({{Moment(1), Ease::linear, {translate(1, 0, 0), rotate(0, 0, 0, 1)}},
                              {Moment(2), Ease::smooth, {translate(2, 0, 0), rotate(90, 0, 0, 1)}},
                              {Moment(3), Ease::step, {translate(4, 0, 0), rotate(0, 0, 0, 1)}},
                              {Moment(3.5), Ease::linear, {translate(8, 0, 0), rotate(0, 0, 0, 1)}}});
  expect_near(keyed.at(Moment(1.5)), Matrix4::translate(1.5, 0, 0) * Matrix4::rotate(45, 0, 0, 1));
  expect_near(keyed.at(Moment(1.25)), Matrix4::translate(1.25, 0, 0) * Matrix4::rotate(22.5, 0, 0, 1));
  expect_near(keyed.at(Moment(2.25)), Matrix4::translate(2.3125, 0, 0) * Matrix4::rotate(90 - 14.0625, 0, 0, 1));
  expect_near(keyed.at(Moment(3.49)), Matrix4::translate(4, 0, 0), 0);
  expect_near(keyed.at(Moment(3.5)), Matrix4::translate(8, 0, 0), 0);
}

TEST(TransformOp, WithoutMeaningIsZero) {
  EXPECT_FALSE(rotate(30, 0, 0, 0).matrix().inverse());
  EXPECT_FALSE(rotate(30, 1e-200, 0, 0).matrix().inverse());
  EXPECT_FALSE((TransformOp{Kind::look_at, {}}).matrix().inverse());
}

TEST(Motion, MultipliesFromTheRight) {
  Motion motion;
  EXPECT_EQ(motion.at(Moment(3)), Matrix4{});
  EXPECT_FALSE(motion.is_keyed());
  motion.multiply(Matrix4::translate(1, 0, 0));
  motion.multiply(Matrix4::scale(2, 2, 2));
  motion.multiply(KeyedTransform(
      {{Moment(0), Ease::linear, {rotate(0, 0, 0, 1)}}, {Moment(9), Ease::linear, {rotate(90, 0, 0, 1)}}}));
  motion.multiply(KeyedTransform(
      {{Moment(0), Ease::linear, {translate(0, 0, 0)}}, {Moment(9), Ease::linear, {translate(9, 0, 0)}}}));
  motion.multiply(Matrix4::translate(0, 0, 5));
  EXPECT_TRUE(motion.is_keyed());
  const Matrix4 expected = Matrix4::translate(1, 0, 0) * Matrix4::scale(2, 2, 2) * Matrix4::rotate(30, 0, 0, 1) *
                           Matrix4::translate(3, 0, 5);
  expect_near(motion.at(Moment(3)), expected);
  expect_near(motion.at(Moment(1.5)), Matrix4::translate(1, 0, 0) * Matrix4::scale(2, 2, 2) *
                                          Matrix4::rotate(15, 0, 0, 1) * Matrix4::translate(1.5, 0, 5));
  expect_near(motion.inverse().at(Moment(3)), *expected.inverse());
  expect_near(motion.inverse().inverse().at(Moment(3)), expected);
  EXPECT_TRUE(motion.inverse().is_keyed());
}

}  // namespace
}  // namespace dspm
