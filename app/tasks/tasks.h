// What dspm does instead of rendering a scene: the tasks of its command line, each of which has a file of its name.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dspm {

class Link;
struct Options;

/// catalogue.cpp: lists every kind with its plugins, one per line.
std::string list_plugins();
/// Describes the parameters of a `kind:name`, or of each plugin of that name; throws UsageError if there is none.
std::string describe_plugins(std::string_view name);

/// Returns the manual page dspm(1) as troff, with all options as --help knows them. [man(7)]
std::string manual_page();

/// completion.cpp: the shells that completion_for() knows.
std::vector<std::string> completing_shells();
/// Returns the script that makes the shell complete dspm's command lines.
std::string completion_for(const std::string& shell);

struct Diagnosis {
  std::string text;
  bool can_render;
};
/// doctor.cpp: renders four pixels whose radiance is known, and looks at the machine and at what else dspm can use.
/// Takes a second or two. `threads` as of --nthreads.
Diagnosis examine_installation(int threads);

/// Writes a starter project for a plugin outside of dspm's tree into a new or empty folder: CMakeLists.txt, the source,
/// and a scene that uses it. They build, and ctest renders the scene. `kind` is integrator, material, area-light, ...;
/// `name` the plugin's. Returns what to type next. Throws UsageError, before anything is written.
std::string new_plugin(const std::string& kind, const std::string& name, const std::filesystem::path& folder);

/// to_dsc.cpp: writes a glTF file as a scene that people can read and edit: shoe.dsc, and its meshes and pictures into
/// the folder shoe, into the current directory, for each of the files; says what was written. Throws UsageError,
/// WriteError or std::runtime_error.
std::string written_as_dsc(const Options& options);

/// Returns whether all scenes on the command line are images: then --sheet and --video show these.
bool are_images(const Options& options);
/// Carries out --compare, --flicker, --sheet and --video of images. Throws UsageError, std::runtime_error.
void look_at_images(const Options& options);

/// relight.cpp: relights images. Arguments that end with .exr are images, the others factors. Returns the exit code;
/// throws UsageError.
int relight_images(const Options& options);

/// plan.cpp: returns the table of --plan, how to share a render out among machines. Throws like render_scene().
std::string plan_of(const Options& options);

/// farm.cpp: returns the names of the kinds of render farms.
std::vector<std::string> farms();
/// Returns a render's parts and their merge as jobs of a farm: a script or a template of the kind options.farm, for this
/// command line.
std::string farm_job(const Options& options);

/// merge.cpp: adds up the checkpoints of a render's parts, and writes what a run of all their iterations would have
/// written. Returns the exit code; throws like render_scene().
int merge_parts(const Options& options);

/// together.cpp: does this machine's share of a render by several machines, which a tool such as mpirun has started. The
/// first one renders with the help of the others, and alone does tasks that render nothing. Returns the exit code;
/// throws what the task throws alone, and UsageError if its options do not go together with other machines.
int render_together(const Options& options, Link& link);

}  // namespace dspm
