#include <fmt/format.h>

#include "dspm/app/options/option_facts.h"
#include "dspm/app/options/options.h"
#include "dspm/app/tasks/tasks.h"
#include "dspm/base/system/version.h"

namespace dspm {
namespace {

/// Returns the text as troff shows it: dashes as typed, lists without spaces broken at commas, and no request.
std::string troff(const std::string& text) {
  std::string all = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text) {
    if (all.ends_with(',') && c != ' ') all += "\\:";
    if (c == '\\')
      all += "\\e";
    else if (c == '-')
      all += "\\-";
    else if (c == '\'')
      all += "\\(aq";
    else
      all += c;
  }
  return all;
}

std::string heading_of(const OptionFacts& option) {
  std::string names;
  for (const std::string& name : option.names)
    names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", troff(name));
  if (option.value.empty()) return names;
  return fmt::format("{}{}\\fI{}\\fR", names, option.has_optional_value() ? "" : " ", troff(option.value));
}

std::string options_as_list() {
  std::string list;
  for (const OptionFacts& option : all_options())
    if (option.is_option()) list += fmt::format(".TP\n{}\n{}\n", heading_of(option), troff(option.sentence));
  return list;
}

constexpr const char* kBefore = R"(.SH NAME
dspm \- render all frames of a scene together
.SH SYNOPSIS
.B dspm
.RI [ options ]
.I scene ...
.SH DESCRIPTION
dspm renders all frames of an animation, or all variations of a product, together.
What is the same in several frames, camera paths, photons and photon maps, is computed once and shared, yet every frame
converges to exactly the image that a renderer would compute for it alone.
The method is Dynamic Stochastic Progressive Photon Mapping (Weiss and Grosch, Eurographics 2012).
.PP
A
.I scene
is text in the format of pbrt\-v4 plus frames
.RI ( .dsc ", " .pbrt ),
which may be compressed
.RI ( .gz ),
or a glTF file
.RI ( .glb ", " .gltf );
\- is standard input.
Several files are read as one, in this order.
.SH OPTIONS
)";

constexpr const char* kAfter = R"(.SH EXIT STATUS
.TP
.B 0
All is done.
.TP
.B 1
The scene or the render failed, or a file could not be written.
.TP
.B 2
The command line makes no sense.
.TP
.B 130
Ctrl\-C has ended the run; images are written.
Other signals end it with 128 and their number.
.SH EXAMPLES
.TP
.B dspm ball.dsc \-\-png \-\-contact\-sheet ball.png
Writes ball.0001.exr, ball.0001.png and so on, and a page of all frames.
.TP
.B dspm ball.dsc \-\-until\-error 2% \-\-denoise
Renders as many iterations as 2% of error take, and images with less noise besides.
.TP
.B dspm ball.dsc \-\-checkpoint ball.ck
Keeps the state every ten minutes; after a crash,
.B \-\-resume ball.ck
goes on to the same bits.
.TP
.B dspm ball.dsc \-\-serve
Shows all frames in a browser while they get better.
.TP
.B dspm \-\-describe material:dielectric
Prints the parameters of a plugin;
.B \-\-list
prints the names of all.
.SH SEE ALSO
The pages in /usr/share/doc/dspm, above all language.md, the reference of scenes, and command\-line.md.
)";

}  // namespace

std::string manual_page() {
  return fmt::format(".TH DSPM 1 \"\" \"dspm {}\" \"User Commands\"\n{}{}{}", kVersion, kBefore, options_as_list(),
                     kAfter);
}

}  // namespace dspm
