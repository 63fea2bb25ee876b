#include "scenes/generator/subjects.h"

namespace dspm {

std::span<const Subject> subjects() {
  static constexpr Subject all[] = {
      {"hall", "the cathedral of horse.dsc and figure9/", make_hall},
      {"animal", "the glass animal of horse.dsc and figure9/", make_animal},
      {"mirror_ball", "the mirror ball of disco.dsc", make_mirror_ball},
      {"glass_ball", "the glass ball of disco.dsc, in 24 frames", make_glass_ball},
      {"water", "the water of water.dsc, in 25 frames", make_water},
      {"pool", "the water of gallery/pool.dsc, in 8 frames", make_pool},
      {"agave", "the plant of water.dsc and gallery/pool.dsc", make_agave},
      {"coffee_pot", "the product of material.dsc", make_coffee_pot},
      {"tableware", "glass and cup of material.dsc", make_tableware},
      {"chair", "the product of chair.dsc", make_chair},
      {"studio", "the things around it", make_studio},
      {"lamp", "the product of lamp.dsc, with three shades", make_lamp},
      {"diamond", "the stone of diamond.dsc", make_diamond},
      {"sky", "a picture of the sky, for product.dsc", make_sky},
      {"wood", "a picture of wood grain", make_wood},
      {"fabrics", "pictures of ten weaves, and 500 variations of them", make_fabrics},
  };
  return all;
}

}  // namespace dspm
