// Any scene's frames together against one by one.
#include "bench/measure/turns.h"

#include "bench/sections/sections.h"

namespace dspm {

Findings measure_turns(const Setup& setup) {
  const LoadedScene loaded = load(setup.scene, setup.defines);
  const TurnSettings settings{.iterations = setup.quick ? 3 : 6, .separate = setup.quick ? 4u : 64u};
  std::string text;
  for (const char* estimator : {"kz11", "hj09"}) {
    const Job job = with_text(loaded.job, "estimator", estimator);
    const InTurns c = take_turns(loaded, job, settings);
    text += fmt::format("{}:\n\n{}\n{}\n\n", estimator, table_of(c, nullptr), dynamic_shares(c));
  }
  return {text, {}};
}

}  // namespace dspm
