// A guide says where photon paths start: it is a density over the lights and over the numbers that their emit() takes,
// constant on cells. It needs nothing else of lights, so it works for those of plugins as well.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dspm/base/math/ray.h"
#include "dspm/base/math/rng.h"
#include "dspm/base/math/vec.h"
#include "dspm/base/system/state_stream.h"
#include "dspm/world/scene/scene.h"

namespace dspm {

/// A box of emission numbers; its sides are powers of two.
struct EmissionBox {
  EmissionNumbers low = {}, size = {1, 1, 1, 1};

  float middle(int side) const { return low[slot(side)] + size[slot(side)] / 2; }
  /// Returns the part below or above the middle of that side.
  EmissionBox half(int side, bool above) const {
    EmissionBox part = *this;
    part.size[slot(side)] /= 2;
    if (above) part.low[slot(side)] = middle(side);
    return part;
  }
  double volume() const {
    double product = 1;
    for (const float length : size) product *= static_cast<double>(length);
    return product;
  }
  static std::size_t slot(int side) { return static_cast<std::size_t>(side); }
};

/// The start of a photon path. `density` is that of the light and its numbers; it is the light's probability if the
/// numbers are uniform.
struct EmissionStart {
  int light = 0;
  EmissionNumbers numbers = {};
  float density = 0;
};

class EmissionGuide {
 public:
  /// A box of one light's numbers: halved, or a cell.
  struct Node {
    double probability = 0;
    int first_child = -1;  // the lower half, followed by the upper one; negative for a cell
    int side = 0;          // the side that is halved
  };

  /// Makes a guide that is off, which guides nothing.
  EmissionGuide() = default;
  /// The first nodes are those of all numbers, light by light; children come after their parents. The probabilities of
  /// the cells add up to 1.
  EmissionGuide(int lights, std::vector<Node> nodes);

  bool is_off() const { return nodes_.empty(); }
  std::size_t cell_count() const { return cell_count_; }
  /// Returns each light's share of the paths; zeros if the guide is off.
  std::vector<double> shares(std::size_t lights) const;
  /// Draws a start with the numbers of kLightChoice, kLightPoint and kLightDirection at bounce 0. It stretches these
  /// numbers halving by halving, so starts are spread over the cells as evenly as the numbers are over their square
  /// [Clarberg et al. 2005]. The guide must not be off.
  EmissionStart draw(const PathRandom& random) const;
  /// Returns the density with which draw() returns these numbers of the light, integrated over those that are
  /// kAnyNumber. The guide must not be off.
  float density(int light, const EmissionNumbers& numbers) const;
  /// Loading throws std::runtime_error unless it finds a guide for that many lights.
  void persist(StateStream& state, int lights);
  std::size_t bytes() const {
    return nodes_.capacity() * sizeof(Node) + steps_.capacity() * sizeof(Step) +
           (shares_.capacity() + light_ends_.capacity()) * sizeof(double);
  }

  static constexpr std::size_t kMostCells = 20'000;

 private:
  /// A node as density() looks it up; it is small because every light sample needs it.
  struct Step {
    float number = 0;        // where it is halved; a cell's density
    std::uint32_t link = 0;  // 4 * first_child + side; 0 for a cell
  };

  double density(std::size_t node, const EmissionNumbers& numbers) const;

  std::vector<Node> nodes_;
  std::vector<Step> steps_;
  std::size_t cell_count_ = 0;
  std::vector<double> shares_;      // of each node: the probability of its cells
  std::vector<double> light_ends_;  // of the lights' parts of the sum of all probabilities, one after the other
};

/// The guides by Scene::light_choices. If there are none, or all are off, lights are chosen by their power.
struct EmissionGuides {
  std::vector<EmissionGuide> of_choice;

  bool are_off() const { return of_choice.empty() || of_choice.front().is_off(); }
  std::size_t cell_count() const;
  std::size_t bytes() const;
  /// Loading throws std::runtime_error unless it finds guides for that many lights.
  void persist(StateStream& state, int lights);
};

/// Returns where a photon path of the frames with that choice starts. The density is 0 if there is no light to start
/// from.
EmissionStart start_of(const EmissionGuides* guides, const Scene& scene, std::size_t choice, const PathRandom& random);

/// Returns each light's share of all photon paths.
std::vector<double> light_shares(const EmissionGuides& guides, const Scene& scene);

/// Returns the density of choosing the light and the numbers with which emit() of its `state` starts this ray, by power
/// if `guides` is null or off; the mean over the choices, see SceneLight::choice_shares. If emission_numbers() does not
/// tell the numbers, it is the light's probability.
float start_density(const EmissionGuides* guides, const Scene& scene, const SceneLight& light, const Light& state,
                    const Ray& ray, const Vec3& normal, int primitive);

}  // namespace dspm
