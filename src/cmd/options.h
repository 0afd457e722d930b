#pragma once
// What the command line asks for: one plain struct per verb, filled by main.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier {

struct CheckOptions {
  std::string file;
  std::vector<std::string> attributes;  // "name=value"
  bool json = false;
};

struct FormatOptions {
  std::vector<std::string> files;  // "-" is standard input
  bool check = false;              // list what would change, write nothing
  bool to_stdout = false;
};

struct ImportOptions {
  std::string file;
  std::string out;  // empty or "-": standard output
  std::optional<int> iterations;
};

struct SampleOptions {
  std::string grammar;
  std::uint32_t count = 16;
  std::uint64_t seed = 1;
  std::optional<std::uint32_t> grow, genes;
  std::string from;                 // a derivation or a run's folder; empty: from the start
  bool only_genes = false;
  std::vector<std::uint32_t> cell;  // width and height on the sheet; empty: as SampleRequest says
  std::uint32_t columns = 0;
  std::vector<std::string> attributes;
  std::string out;  // empty: out/NAME-samples
  int threads = 0;
};

/// Of meshes in files.
struct DetailOptions {
  std::string joints;                // "separate", "smooth"; empty: not given
  std::optional<std::uint32_t> lod;
  bool lods = false;                 // all levels, a file each
};

struct BreedOptions {
  std::string from;     // a derivation, a run's folder, a grammar or a scene
  std::string grammar;  // of a derivation; empty: the copy in the folder of its run
  std::uint32_t count = 20;
  std::optional<std::uint64_t> most_triangles;
  double strength = 0.3, least_distance = 0.01;
  std::uint64_t seed = 1;
  std::string format = "glb";
  DetailOptions detail;
  std::vector<std::string> attributes;
  std::string out;  // empty: out/NAME-species
  int threads = 0;
};

struct RunVerbOptions {
  std::string scene;   // or else:
  std::string resume;  // folder to go on from
  bool force = false;
  std::optional<double> checkpoint_seconds;
  std::string from;                // derivation to start from
  std::vector<std::string> locks;  // "PATH" or "PATH:scope"
  std::optional<std::string> engine;
  std::optional<std::uint64_t> seed;
  std::optional<double> seconds;
  std::optional<std::uint64_t> evaluations, generations;
  std::optional<int> threads;
  std::optional<std::uint32_t> keep;
  std::vector<std::string> settings, attributes;
  std::string out;  // empty: out/NAME
  bool json = false;
};

/// What compare and sweep share.
struct ContestOptions {
  std::string scene;
  std::string seeds = "5", clock = "wall";
  std::optional<std::uint64_t> seed;
  std::optional<double> seconds;
  std::optional<std::uint64_t> evaluations, generations;
  std::vector<std::string> settings, attributes;
  int threads = 0;
  std::string out;
  bool json = false;
};

struct CompareOptions : ContestOptions {
  std::string engines;                // empty: all, unless there are variants
  std::vector<std::string> variants;  // "NAME: KEY=VALUE, ..."
  std::string marks;
};

struct SweepOptions : ContestOptions {
  std::vector<std::string> varied;  // "KEY=VALUE,VALUE"
  std::optional<std::string> engine;
  std::optional<std::uint32_t> random;
  bool curves = false;
};

struct PreviewOptions {
  std::string scene;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> settings, attributes;
  std::string out;  // empty: out/NAME-preview.png
  int threads = 0;
  bool json = false;
};

struct ScoreOptions {
  std::string scene, derivation;
  std::vector<std::string> settings, attributes;
  bool json = false;
};

struct InspectOptions {
  std::string file;
  std::string grammar;  // of a derivation; empty: the copy in its run's folder
  bool genes = false;
  bool json = false;
};

struct ReproduceOptions {
  std::string file;
  std::string run_folder;  // empty: where the file says
  int threads = 0;
};

struct ExportVerbOptions {
  std::string derivation, grammar, out;
  std::vector<std::string> attributes;
  DetailOptions detail;
};

struct RenderOptions {
  std::string file, grammar, out, frames;
  std::vector<std::string> attributes;
  std::string size;       // "1200x900"; empty: that, for turntables 400x300
  std::string eye, at;    // "x,y,z"; empty: not given
  std::optional<double> azimuth, elevation, fov, tall;
  std::uint32_t samples = 16, columns = 0;
  std::optional<std::uint32_t> turntable;
  bool no_ground = false, transparent = false, targets = false;
  std::string background, view = "full", light;
  DetailOptions detail;   // never all levels
  int threads = 0;
};

struct SimilarityOptions {
  std::vector<std::string> models;
  std::string grammar;
  std::vector<std::string> attributes;
  std::uint32_t grid = 4, pairs = 30, bins = 10;
  std::optional<double> range;              // metres
  std::string box = "own", over = "all";
  std::uint64_t seed = 1;
  std::string csv;                          // file to write; empty: none
  int threads = 0;
  bool json = false;
};

struct GraphOptions {
  std::string file;                     // a grammar, or a .derivation.json
  std::string grammar;                  // of a derivation; empty: the copy in its run's folder
  std::vector<std::string> attributes;
  std::string out;                      // .svg; empty: standard output
};

struct StudioOptions {
  std::string project;  // name, or a project file; empty: the list of projects
  std::uint16_t port = 7411;
  bool open = true;     // in the desktop's browser
  bool new_token = false;  // links of earlier starts lead nowhere from now on
  std::string data;     // where projects are kept; empty: below the home folder
  std::string page;     // folder; empty: beside the program
};

struct ExplainOptions {
  std::string grammar;
  std::vector<std::string> attributes;
  std::uint32_t samples = 1000;
  std::uint64_t seed = 1;
  bool json = false;
};

}  // namespace espalier
