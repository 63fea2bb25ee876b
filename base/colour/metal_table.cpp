// Optical constants of metals and oxides: index of refraction eta and absorption k. The numbers are those of pbrt-v4's
// spectra of the same names, so that scenes look the same (pbrt took them from the luxpop collection; brass is CuZn
// with 30% zinc, refractiveindex.info after Querry 1985).
#include "dspm/base/colour/spectrum_tables.h"

namespace dspm {
namespace {

// Silver to copper are tabulated over photon energy: 3.45 eV to 1.45 eV in steps of 0.05 eV; nm = hc / eV.
constexpr int kEnergySamples = 41;
using EnergyTable = std::array<float, kEnergySamples>;
constexpr EnergyTable kEnergyNm = [] {
  EnergyTable nm{};
  for (int i = 0; i < kEnergySamples; ++i)
    nm[static_cast<std::size_t>(i)] = static_cast<float>(1239.8417 / (3.45 - 0.05 * i));
  return nm;
}();

constexpr EnergyTable kSilverEta{
    0.194813f, 0.186f, 0.192063f, 0.2f,   0.198063f, 0.192f, 0.182f,    0.173f, 0.172625f, 0.173f, 0.166688f, 0.16f,
    0.1585f,   0.157f, 0.151063f, 0.144f, 0.137313f, 0.132f, 0.13025f,  0.13f,  0.129938f, 0.13f,  0.130063f, 0.129f,
    0.124375f, 0.12f,  0.119313f, 0.121f, 0.1255f,   0.131f, 0.136125f, 0.14f,  0.140063f, 0.14f,  0.144313f, 0.148f,
    0.145875f, 0.143f, 0.142563f, 0.145f, 0.151938f};
constexpr EnergyTable kSilverK{1.53375f,  1.61f, 1.641875f, 1.67f, 1.735f,    1.81f, 1.87875f,  1.95f, 2.029375f, 2.11f,
                               2.18625f,  2.26f, 2.329375f, 2.4f,  2.47875f,  2.56f, 2.64f,     2.72f, 2.798125f, 2.88f,
                               2.97375f,  3.07f, 3.159375f, 3.25f, 3.348125f, 3.45f, 3.55375f,  3.66f, 3.76625f,  3.88f,
                               4.010625f, 4.15f, 4.293125f, 4.44f, 4.58625f,  4.74f, 4.908125f, 5.09f, 5.28875f,  5.5f,
                               5.720624f};
constexpr EnergyTable kAluminiumEta{
    0.39575f, 0.407f,    0.419125f, 0.432f,    0.445688f, 0.46f,     0.474688f, 0.49f,    0.506188f, 0.523f, 0.540063f,
    0.558f,   0.577313f, 0.598f,    0.620313f, 0.644f,    0.668625f, 0.695f,    0.72375f, 0.755f,    0.789f, 0.826f,
    0.867f,   0.912f,    0.963f,    1.02f,     1.08f,     1.15f,     1.22f,     1.3f,     1.39f,     1.49f,  1.6f,
    1.74f,    1.91f,     2.14f,     2.41f,     2.63f,     2.8f,      2.74f,     2.58f};
constexpr EnergyTable kAluminiumK{
    4.365f, 4.43f, 4.49375f, 4.56f, 4.63375f, 4.71f, 4.784375f, 4.86f, 4.938125f, 5.02f, 5.10875f, 5.2f,  5.29f, 5.38f,
    5.48f,  5.58f, 5.69f,    5.8f,  5.915f,   6.03f, 6.15f,     6.28f, 6.42f,     6.55f, 6.7f,     6.85f, 7.f,   7.15f,
    7.31f,  7.48f, 7.65f,    7.82f, 8.01f,    8.21f, 8.39f,     8.57f, 8.62f,     8.6f,  8.45f,    8.31f, 8.21f};
constexpr EnergyTable kGoldEta{
    1.727625f, 1.716f,    1.705875f, 1.696f,    1.68475f,  1.674f,    1.666f,    1.658f,   1.64725f, 1.636f,  1.628f,
    1.616f,    1.59625f,  1.562f,    1.502125f, 1.426f,    1.345875f, 1.242f,    1.08675f, 0.916f,   0.7545f, 0.608f,
    0.49175f,  0.402f,    0.3455f,   0.306f,    0.267625f, 0.236f,    0.212375f, 0.194f,   0.17775f, 0.166f,  0.161f,
    0.16f,     0.160875f, 0.164f,    0.1695f,   0.176f,    0.181375f, 0.188f,    0.198125f};
constexpr EnergyTable kGoldK{
    1.852375f, 1.862f, 1.883f,    1.906f, 1.9225f,   1.936f, 1.94775f,  1.956f, 1.959375f, 1.958f, 1.951375f, 1.94f,
    1.9245f,   1.904f, 1.875875f, 1.846f, 1.814625f, 1.796f, 1.797375f, 1.84f,  1.9565f,   2.12f,  2.32625f,  2.54f,
    2.730625f, 2.88f,  2.940625f, 2.97f,  3.015f,    3.06f,  3.07f,     3.15f,  3.445812f, 3.8f,   4.087687f, 4.357f,
    4.610188f, 4.86f,  5.125813f, 5.39f,  5.63125f};
constexpr EnergyTable kCopperEta{
    1.281563f, 1.27f,  1.249062f, 1.225f, 1.2f,      1.18f,  1.174375f, 1.175f, 1.1775f,   1.18f,  1.178125f, 1.175f,
    1.172812f, 1.17f,  1.165312f, 1.16f,  1.155312f, 1.15f,  1.142812f, 1.135f, 1.131562f, 1.12f,  1.092437f, 1.04f,
    0.950375f, 0.826f, 0.645875f, 0.468f, 0.35125f,  0.272f, 0.230813f, 0.214f, 0.20925f,  0.213f, 0.21625f,  0.223f,
    0.2365f,   0.25f,  0.254188f, 0.26f,  0.28f};
constexpr EnergyTable kCopperK{
    1.931688f, 1.95f,  1.972438f, 2.015f, 2.121562f, 2.21f,  2.177188f, 2.13f,  2.160063f, 2.21f,  2.249938f, 2.289f,
    2.326f,    2.362f, 2.397625f, 2.433f, 2.469187f, 2.504f, 2.535875f, 2.564f, 2.589625f, 2.605f, 2.595562f, 2.583f,
    2.5765f,   2.599f, 2.678062f, 2.809f, 3.01075f,  3.24f,  3.458187f, 3.67f,  3.863125f, 4.05f,  4.239563f, 4.43f,
    4.619563f, 4.817f, 5.034125f, 5.26f,  5.485625f};

constexpr int kBrassSamples = 48;  // 360 to 830 nm
using BrassTable = std::array<float, kBrassSamples>;
constexpr BrassTable kBrassNm = [] {
  BrassTable nm{};
  for (int i = 0; i < kBrassSamples; ++i) nm[static_cast<std::size_t>(i)] = static_cast<float>(360 + 10 * i);
  return nm;
}();
constexpr BrassTable kBrassEta{1.503f, 1.497f, 1.487f, 1.471f, 1.445f, 1.405f, 1.35f,  1.278f, 1.191f, 1.094f,
                               0.994f, 0.9f,   0.816f, 0.745f, 0.686f, 0.639f, 0.602f, 0.573f, 0.549f, 0.527f,
                               0.505f, 0.484f, 0.468f, 0.46f,  0.45f,  0.452f, 0.449f, 0.445f, 0.444f, 0.444f,
                               0.445f, 0.444f, 0.444f, 0.445f, 0.446f, 0.448f, 0.45f,  0.452f, 0.455f, 0.457f,
                               0.458f, 0.46f,  0.464f, 0.469f, 0.473f, 0.478f, 0.481f, 0.483f};
constexpr BrassTable kBrassK{1.815f, 1.818f, 1.818f, 1.813f, 1.805f, 1.794f, 1.786f, 1.784f, 1.797f, 1.829f,
                             1.883f, 1.957f, 2.046f, 2.145f, 2.25f,  2.358f, 2.464f, 2.568f, 2.668f, 2.765f,
                             2.86f,  2.958f, 3.059f, 3.159f, 3.253f, 3.345f, 3.434f, 3.522f, 3.609f, 3.695f,
                             3.778f, 3.86f,  3.943f, 4.025f, 4.106f, 4.186f, 4.266f, 4.346f, 4.424f, 4.501f,
                             4.579f, 4.657f, 4.737f, 4.814f, 4.89f,  4.965f, 5.039f, 5.115f};

constexpr std::array<float, 26> kMagnesiaNm{351.119f, 360.932f, 364.969f, 382.065f, 386.712f, 393.338f, 404.634f,
                                            430.935f, 435.782f, 457.829f, 477.949f, 486.005f, 487.918f, 499.919f,
                                            502.35f,  508.532f, 514.44f,  546.167f, 589.259f, 632.874f, 643.718f,
                                            656.326f, 667.636f, 690.696f, 706.439f, 767.678f};
constexpr std::array<float, 26> kMagnesiaEta{1.7768f,  1.7732f,  1.77186f, 1.7668f,  1.7655f,  1.7638f, 1.76104f,
                                             1.7557f,  1.75471f, 1.7512f,  1.7483f,  1.74711f, 1.7469f, 1.7454f,
                                             1.7453f,  1.74446f, 1.7439f,  1.74077f, 1.73737f, 1.7346f, 1.734f,
                                             1.73335f, 1.73277f, 1.73191f, 1.73101f, 1.72872f};
constexpr std::array<float, 2> kMagnesiaKNm{351.119f, 767.678f}, kMagnesiaK{0, 0};  // below 1e-6

constexpr std::array<float, 28> kTitaniaNm{359.988f, 388.044f, 399.935f, 412.031f, 419.986f, 439.957f, 460.037f,
                                           479.985f, 499.919f, 520.05f,  539.044f, 539.983f, 559.982f, 579.888f,
                                           600.097f, 619.9f,   640.062f, 659.819f, 680.088f, 700.056f, 719.977f,
                                           740.179f, 760.147f, 779.748f, 799.871f, 819.974f, 839.973f, 859.778f};
constexpr std::array<float, 28> kTitaniaEta{3.87f, 3.49f, 3.4f,  3.24f, 3.29f, 3.2f,  3.13f, 3.08f, 3.03f, 3.f,
                                            2.95f, 2.97f, 2.94f, 2.92f, 2.9f,  2.88f, 2.87f, 2.85f, 2.84f, 2.83f,
                                            2.82f, 2.81f, 2.81f, 2.8f,  2.79f, 2.79f, 2.78f, 2.78f};
constexpr std::array<float, 6> kTitaniaKNm{359.988f, 388.044f, 399.935f, 412.031f, 419.986f, 859.778f};
constexpr std::array<float, 6> kTitaniaK{0.251f, 0, 0, 0.022f, 0, 0};

constexpr NamedTable kTables[] = {
    {"metal-Ag-eta", kEnergyNm, kSilverEta},      {"metal-Ag-k", kEnergyNm, kSilverK},
    {"metal-Al-eta", kEnergyNm, kAluminiumEta},   {"metal-Al-k", kEnergyNm, kAluminiumK},
    {"metal-Au-eta", kEnergyNm, kGoldEta},        {"metal-Au-k", kEnergyNm, kGoldK},
    {"metal-Cu-eta", kEnergyNm, kCopperEta},      {"metal-Cu-k", kEnergyNm, kCopperK},
    {"metal-CuZn-eta", kBrassNm, kBrassEta},      {"metal-CuZn-k", kBrassNm, kBrassK},
    {"metal-MgO-eta", kMagnesiaNm, kMagnesiaEta}, {"metal-MgO-k", kMagnesiaKNm, kMagnesiaK},
    {"metal-TiO2-eta", kTitaniaNm, kTitaniaEta},  {"metal-TiO2-k", kTitaniaKNm, kTitaniaK},
};

}  // namespace

std::span<const NamedTable> metal_tables() { return kTables; }

}  // namespace dspm
