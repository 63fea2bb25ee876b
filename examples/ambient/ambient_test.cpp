// How much of the sky is seen, in cases where that is known.
#include <dspm/testing/agreement.h>
#include <dspm/testing/checks.h>
#include <dspm/testing/scenes.h>

int main(int count, char** arguments) {
  using namespace dspm;
  using namespace dspm::test;
  return run_checks(count, arguments, [](Checks& checks) {
    checks.add("on a plane: all",
               [&] { return agreement(rendered(open_furnace("\"ambient\"", "\"diffuse\""), 2), Rgb(1)); });
    checks.add("inside a sphere: nothing", [&] { return agreement(rendered(furnace("\"ambient\"", 0), 2), Rgb(0)); });
    // A ray at an angle a from the normal of a sphere of radius 2 goes 4 cos a far. With the density of the rays,
    // cos a / pi, the share cos^2 a = 1/16 of them is met within a distance of 1.
    checks.add("inside a sphere, to a distance of 1",
               [&] { return agreement(rendered(furnace("\"ambient\" \"float distance\" 1", 0), 16), Rgb(15 / 16.f)); });
  });
}
