// The paper's measurements: Weiss and Grosch, Stochastic Progressive Photon Mapping for Dynamic Scenes, Eurographics
// 2012, tables 1 to 3. On a machine of its time, 512 x 512 pixels, with models of its own: only ratios can be compared.
#pragma once

#include <array>

namespace dspm::wg12 {

/// Speedups of a joint run over separate ones: hit points, photons, kd-tree, pixel statistics, total.
using Speedups = std::array<double, 5>;

struct HorseRow {
  int frames;
  Speedups speedups;  // table 1
  double megabytes;   // table 2
};
inline constexpr std::array<HorseRow, 4> kHorse = {{{8, {3.84, 6.07, 5.23, 3.44, 5.09}, 282},
                                                    {16, {5.28, 9.84, 9.50, 3.92, 7.52}, 479},
                                                    {24, {6.05, 12.24, 14.17, 3.76, 8.86}, 678},
                                                    {32, {6.25, 14.29, 18.13, 3.14, 9.34}, 874}}};
inline constexpr double kSppmMegabytes = 245;  // table 2, one frame

struct SceneRow {  // table 3
  const char* name;
  int frames;
  double dynamic_photons, dynamic_hit_points;  // shares of the paths
  Speedups speedups;
};
inline constexpr std::array<SceneRow, 3> kScenes = {{{"disco", 24, 0.088, 0.10, {1.07, 8.58, 9.48, 3.90, 6.07}},
                                                     {"water", 25, 0.030, 0.155, {1.51, 5.19, 16.59, 4.91, 3.50}},
                                                     {"material", 16, 0.108, 0.302, {0.87, 1.58, 9.67, 6.82, 1.96}}}};

/// Of the nine scenes of figure 9.
inline constexpr double kLeastSpeedup = 2.48, kMostSpeedup = 9.53;

}  // namespace dspm::wg12
