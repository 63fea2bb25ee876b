#include "dspm/integrators/photons/emission_guide.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/vec.h"
#include "dspm/integrators/dimension.h"

namespace dspm {
namespace {

bool are_valid(const std::vector<EmissionGuide::Node>& nodes, int lights) {
  std::size_t next_child = static_cast<std::size_t>(lights);
  for (const EmissionGuide::Node& node : nodes) {
    if (!(std::isfinite(node.probability) && node.probability >= 0) || node.side < 0 || node.side > 3) return false;
    if (node.first_child >= 0) next_child += 2;
  }
  if (!nodes.empty() && next_child != nodes.size()) return false;
  std::vector<bool> has_parent(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].first_child < 0) continue;
    const auto child = static_cast<std::size_t>(nodes[i].first_child);
    if (child <= i || child < static_cast<std::size_t>(lights) || child + 1 >= nodes.size() || has_parent[child] ||
        has_parent[child + 1])
      return false;
    has_parent[child] = has_parent[child + 1] = true;
  }
  return true;
}

}  // namespace

EmissionGuide::EmissionGuide(int lights, std::vector<Node> nodes)
    : nodes_(std::move(nodes)), shares_(nodes_.size()), light_ends_(static_cast<std::size_t>(lights)) {
  std::vector<EmissionBox> boxes(nodes_.size());
  steps_.reserve(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.first_child < 0) {
      ++cell_count_;
      steps_.push_back({static_cast<float>(node.probability / boxes[i].volume()), 0});
    } else {
      steps_.push_back({boxes[i].middle(node.side), static_cast<std::uint32_t>(4 * node.first_child + node.side)});
      for (const bool above : {false, true})
        boxes[static_cast<std::size_t>(node.first_child + above)] = boxes[i].half(node.side, above);
    }
  }
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const auto child = static_cast<std::size_t>(nodes_[i].first_child);
    shares_[i] = nodes_[i].first_child < 0 ? nodes_[i].probability : shares_[child] + shares_[child + 1];
  }
  std::partial_sum(shares_.begin(), shares_.begin() + lights, light_ends_.begin());
}

EmissionStart EmissionGuide::draw(const PathRandom& random) const {
  // 24 bits would never reach cells of small probability.
  const Vec2 choice = random.pair(0, kLightChoice), position = random.pair(0, kLightPoint),
             direction = random.pair(0, kLightDirection);
  const double finer = 0x1p-24 * static_cast<double>(choice.y);
  const double u = (static_cast<double>(choice.x) + finer) * light_ends_.back();
  const auto light =
      static_cast<std::size_t>(std::upper_bound(light_ends_.begin(), light_ends_.end() - 1, u) - light_ends_.begin());
  std::array<double, 4> rest;  // of each number, within the box
  const EmissionNumbers uniform = {position.x, position.y, direction.x, direction.y};
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = static_cast<double>(uniform[i]) + finer;
  EmissionBox box;
  std::size_t node = light;
  while (steps_[node].link != 0) {
    const std::size_t child = steps_[node].link / 4, side = steps_[node].link % 4;
    const double below = shares_[child] / shares_[node];
    const bool above = !(rest[side] < below);
    rest[side] = above ? (rest[side] - below) / (1 - below) : rest[side] / below;
    box.size[side] /= 2;
    if (above) box.low[side] += box.size[side];
    node = child + above;
  }
  EmissionStart start{static_cast<int>(light), {}, steps_[node].number};
  // Rounding may reach the end of the cell, where density() finds the next one.
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const float end = box.low[i] + box.size[i];
    start.numbers[i] = std::min(box.low[i] + box.size[i] * static_cast<float>(rest[i]), std::nextafter(end, 0.f));
  }
  return start;
}

float EmissionGuide::density(int light, const EmissionNumbers& numbers) const {
  return static_cast<float>(density(static_cast<std::size_t>(light), numbers));
}

// A side of which any number will do keeps its length of 1, and both halves of it count: each cell's density then is
// over half of it.
double EmissionGuide::density(std::size_t node, const EmissionNumbers& numbers) const {
  for (;;) {
    const Step step = steps_[node];
    if (step.link == 0) return static_cast<double>(step.number);
    const std::size_t child = step.link / 4;
    const float number = numbers[step.link % 4];
    if (number == kAnyNumber) return (density(child, numbers) + density(child + 1, numbers)) / 2;
    node = child + (number >= step.number);
  }
}

std::vector<double> EmissionGuide::shares(std::size_t lights) const {
  std::vector<double> shares(lights);
  for (std::size_t i = 0; i < light_ends_.size(); ++i) shares[i] = shares_[i] / light_ends_.back();
  return shares;
}

void EmissionGuide::persist(StateStream& state, int lights) {
  std::vector<Node> nodes = nodes_;
  state.list(nodes, 2 * kMostCells + static_cast<std::size_t>(lights));
  if (!are_valid(nodes, lights)) throw std::runtime_error("its record of where photons start is damaged");
  *this = nodes.empty() ? EmissionGuide() : EmissionGuide(lights, std::move(nodes));
}

std::size_t EmissionGuides::cell_count() const {
  std::size_t sum = 0;
  for (const EmissionGuide& guide : of_choice) sum += guide.cell_count();
  return sum;
}

std::size_t EmissionGuides::bytes() const {
  std::size_t sum = 0;
  for (const EmissionGuide& guide : of_choice) sum += guide.bytes();
  return sum;
}

void EmissionGuides::persist(StateStream& state, int lights) {
  constexpr std::uint64_t kMostChoices = 1 << 10;
  std::uint64_t count = of_choice.size();
  state.value(count);
  if (count > kMostChoices) throw std::runtime_error("its record of where photons start is damaged");
  of_choice.resize(static_cast<std::size_t>(count));
  for (EmissionGuide& guide : of_choice) guide.persist(state, lights);
}

EmissionStart start_of(const EmissionGuides* guides, const Scene& scene, std::size_t choice, const PathRandom& random) {
  if (guides != nullptr && !guides->are_off()) return guides->of_choice[choice].draw(random);
  const ChosenLight chosen = scene.light_choices[choice].choose(random.number(0, kLightChoice));
  const Vec2 position = random.pair(0, kLightPoint), direction = random.pair(0, kLightDirection);
  return {chosen.index, {position.x, position.y, direction.x, direction.y}, chosen.probability};
}

std::vector<double> light_shares(const EmissionGuides& guides, const Scene& scene) {
  const std::size_t count = scene.lights.size();
  std::vector<double> shares(count);
  for (std::size_t c = 0; c < scene.light_choices.size(); ++c) {
    const LightChoice& choice = scene.light_choices[c];
    const std::vector<double> guided = guides.are_off() ? std::vector<double>() : guides.of_choice[c].shares(count);
    for (std::size_t i = 0; i < count; ++i)
      shares[i] += static_cast<double>(choice.share) *
                   (guides.are_off() ? static_cast<double>(choice.probability()[i]) : guided[i]);
  }
  return shares;
}

float start_density(const EmissionGuides* guides, const Scene& scene, const SceneLight& light, const Light& state,
                    const Ray& ray, const Vec3& normal, int primitive) {
  const auto index = static_cast<std::size_t>(&light - scene.lights.data());
  const bool guided = guides != nullptr && !guides->are_off();
  EmissionNumbers numbers{};
  if (guided) numbers = state.emission_numbers(ray, normal, primitive);
  float density = 0;
  for (std::size_t choice = 0; choice < light.choice_shares.size(); ++choice) {
    if (light.choice_shares[choice] == 0) continue;
    density +=
        light.choice_shares[choice] * (guided ? guides->of_choice[choice].density(static_cast<int>(index), numbers)
                                              : scene.light_choices[choice].probability()[index]);
  }
  return density;
}

}  // namespace dspm
