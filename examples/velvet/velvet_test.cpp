// Velvet scatters as its samples say, and under an even sky it looks as bright as it should.
#include <dspm/testing/checks.h>
#include <dspm/testing/furnace.h>
#include <dspm/testing/scattering.h>

int main(int count, char** arguments) {
  using namespace dspm::test;
  return run_checks(count, arguments, [](Checks& checks) {
    for (const char* falloff : {"1", "4", "64"}) {
      const std::string velvet =
          R"("velvet" "rgb reflectance" [.25 .5 1] "rgb rim" [.9 .4 1] "float falloff" )" + std::string(falloff);
      checks.add("scattering of " + velvet, [&] { return check_scattering(velvet); });
      checks.add("the open furnace with " + velvet, [&] { return check_open_furnace(velvet); });
    }
  });
}
