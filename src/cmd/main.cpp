// espalier: the command line. Declares the options of every verb, fills its struct, calls it.
#include <csignal>
#include <cstdio>
#include <functional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "base/version.h"
#include "cmd/declare.h"
#include "cmd/verbs.h"

namespace espalier {
namespace {

constexpr const char* kExamples = R"(Examples:
  espalier check grammars/spaceship.esp
  espalier fmt --check grammars/*.esp
  espalier sample grammars/spaceship.esp -n 16 --seed 3 --out out/ships
  espalier run scenes/spaceship.toml --time 10 --out out/ship
  espalier run scenes/spaceship.toml --evaluations 20000 --set search.population=200
  espalier run scenes/spaceship.toml --checkpoint-every 10 --out out/ship
  espalier run --resume out/ship --time 60
  espalier run scenes/spaceship.toml --from out/ship --lock Ship/Body/Body
  espalier compare scenes/spaceship.toml --engines ga,rjmcmc,hybrid --seeds 5 --time 10
  espalier sweep scenes/spaceship.toml --vary search.population=20,100,500 --time 5
  espalier breed --from out/oak.derivation.json --count 200 --max-triangles 5000
  espalier preview scenes/tree-heart.toml -o preview.png
  espalier score out/ship/run.toml out/ship/best.derivation.json
  espalier inspect out/ship/best.png
  espalier reproduce out/ship/best.glb
  espalier export out/ship/best.derivation.json -o ship.stl
  espalier render out/ship -o ship.png --size 1600x1200
  espalier similarity out/ship out/ship/alternatives/01.glb --pairs 1000
  espalier graph grammars/spaceship.esp -o spaceship.svg
  espalier explain grammars/spaceship.esp
  espalier studio

Exit codes: 0 done, 1 a comparison failed or there is no result, 2 bad input.)";

/// All verbs' options, and which verb was asked for.
struct CommandLine {
  CheckOptions check;
  FormatOptions format;
  ImportOptions import_;
  SampleOptions sample;
  BreedOptions breed;
  RunVerbOptions run;
  CompareOptions compare;
  SweepOptions sweep;
  PreviewOptions preview;
  ScoreOptions score;
  InspectOptions inspect;
  ReproduceOptions reproduce;
  ExportVerbOptions export_;
  RenderOptions render;
  SimilarityOptions similarity;
  GraphOptions graph;
  ExplainOptions explain;
  StudioOptions studio;
  std::function<int()> verb;
};

void declare_check(CLI::App& app, CommandLine& line) {
  CLI::App* verb = app.add_subcommand("check", "Say what is wrong with a grammar");
  CheckOptions& o = line.check;
  verb->add_option("grammar", o.file, "Grammar file (.esp)")->required();
  declare_attributes(verb, o.attributes);
  verb->add_flag("--json", o.json, "Diagnostics as JSON");
  verb->callback([&line] { line.verb = [&line] { return check_verb(line.check); }; });
}

void declare_format(CLI::App& app, CommandLine& line) {
  CLI::App* verb = app.add_subcommand("fmt", "Put grammars into the layout of the house");
  FormatOptions& o = line.format;
  verb->add_option("files", o.files, "Grammar files (.esp), replaced in place; - formats stdin to stdout")->required();
  verb->add_flag("--check", o.check, "Change nothing; list the files that would change and exit with 1");
  verb->add_flag("--stdout", o.to_stdout, "Write to stdout instead of the files");
  verb->callback([&line] { line.verb = [&line] { return format_verb(line.format); }; });
}

void declare_import(CLI::App& app, CommandLine& line) {
  CLI::App* verb = app.add_subcommand("import", "Write an L-system as a grammar");
  ImportOptions& o = line.import_;
  verb->add_option("file", o.file, "L-system (.lsys), see docs/from-lsystems.md")->required();
  verb->add_option("-o,--out", o.out, "Grammar to write (stdout)");
  verb->add_option("--iterations", o.iterations, "Rewriting steps, instead of the file's")->check(CLI::Range(1, 40));
  verb->callback([&line] { line.verb = [&line] { return import_verb(line.import_); }; });
}

void declare_sample(CLI::App& app, CommandLine& line) {
  CLI::App* verb = app.add_subcommand("sample", "Draw models from a grammar, without any target");
  SampleOptions& o = line.sample;
  verb->add_option("grammar", o.grammar, "Grammar file (.esp)")->required();
  verb->add_option("-n,--count", o.count, "How many, 1 to 1000 (16)")->check(CLI::Range(1, 1000));
  verb->add_option("--seed", o.seed, "Seed (1)")->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62));
  auto* grow = verb->add_option("--grow", o.grow, "Only this many steps of growth from the start");
  grow->check(CLI::Range(0, 1'000'000));
  verb->add_option("--from", o.from, "With --grow: grow on from this .derivation.json, or run's folder (its best)")
      ->needs(grow);
  verb->add_option("--genes", o.genes, "Grow each to this many genes, as searches start")
      ->check(CLI::Range(1, 1'000'000))->excludes(grow);
  verb->add_flag("--only-genes", o.only_genes, "Write derivations only, no models and no pictures");
  verb->add_option("--size", o.cell, "Width,height of a model on the sheet (400,300)")
      ->expected(2)->delimiter(',')->check(CLI::Range(16, 1024));
  verb->add_option("--columns", o.columns, "Columns of the sheet (as near to 4:3 as the count allows)")
      ->check(CLI::Range(1, 100));
  declare_attributes(verb, o.attributes);
  declare_threads(verb, o.threads);
  verb->add_option("--out", o.out, "Folder to write (out/NAME-samples)");
  verb->callback([&line] { line.verb = [&line] { return sample_verb(line.sample); }; });
}

void declare_run(CLI::App& app, CommandLine& line) {
  CLI::App* verb = app.add_subcommand("run", "Search a scene until its budget is spent, or Ctrl-C");
  RunVerbOptions& o = line.run;
  verb->add_option("scene", o.scene, "Scene file (.toml)");
  verb->add_option("--resume", o.resume, "Instead of a scene: go on with the run of this folder, from its checkpoint");
  verb->add_flag("--force", o.force, "With --resume, where inputs have changed: search anew from its models");
  verb->add_option("--checkpoint-every", o.checkpoint_seconds, "Keep a checkpoint every so many seconds of the search")
      ->check(CLI::Range(1e-3, 1e6));
  verb->add_option("--from", o.from, "Start from this model: a .derivation.json, or a run's folder (its best)");
  verb->add_option("--lock", o.locks, "Keep this gene of it and all below: Hull/Wing[1]; only its numbers: Hull:draws; "
                                      "all but numbers: Hull:structure (repeatable)")
      ->expected(1)->take_all();
  verb->add_option("--engine", o.engine, "Search engine");
  verb->add_option("--seed", o.seed, "Seed")->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62));
  verb->add_option("--time", o.seconds, "Stop after this many seconds (replaces the scene's budget)");
  verb->add_option("--evaluations", o.evaluations, "Stop after this many evaluations (replaces the scene's budget)");
  verb->add_option("--generations", o.generations, "Stop after this many steps (replaces the scene's budget)");
  verb->add_option("--threads", o.threads, "Threads to use; 0 = one per core. Results do not depend on it")
      ->check(CLI::Range(0, 1024));
  declare_settings(verb, o.settings);
  declare_attributes(verb, o.attributes);
  verb->add_option("--keep", o.keep, "Alternatives to keep beside the best");
  verb->add_option("--out", o.out, "Folder to write (out/NAME); an earlier run there is replaced");
  verb->add_flag("--json", o.json, "Events as JSON lines");
  verb->callback([&line, verb] {
    refuse_empty_values(verb);
    line.verb = [&line] { return run_verb(line.run); };
  });
}

void declare_preview(CLI::App& app, CommandLine& line) {
  CLI::App* verb = app.add_subcommand("preview", "Show what a scene asks for, and four samples, before any search");
  PreviewOptions& o = line.preview;
  verb->add_option("scene", o.scene, "Scene file (.toml)")->required();
  verb->add_option("-o,--out", o.out, "Picture to write: .png (out/NAME-preview.png)");
  verb->add_option("--seed", o.seed, "Seed")->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62));
  declare_settings(verb, o.settings);
  declare_attributes(verb, o.attributes);
  declare_threads(verb, o.threads);
  verb->add_flag("--json", o.json, "As JSON");
  verb->callback([&line] { line.verb = [&line] { return preview_verb(line.preview); }; });
}

void declare_score(CLI::App& app, CommandLine& line) {
  CLI::App* verb = app.add_subcommand("score", "Score a derivation in a scene and take the score apart");
  ScoreOptions& o = line.score;
  verb->add_option("scene", o.scene, "Scene file, or the run.toml of a run")->required();
  verb->add_option("derivation", o.derivation, "A .derivation.json")->required();
  declare_settings(verb, o.settings);
  declare_attributes(verb, o.attributes);
  verb->add_flag("--json", o.json, "As JSON");
  verb->callback([&line] { line.verb = [&line] { return score_verb(line.score); }; });
}

void declare_file_verbs(CLI::App& app, CommandLine& line) {
  CLI::App* inspect = app.add_subcommand("inspect", "Show where a file came from: seed, settings, inputs, score");
  inspect->add_option("file", line.inspect.file, "Any model, picture or JSON that espalier wrote")->required();
  inspect->add_flag("--genes", line.inspect.genes, "List a derivation's genes: number, path, rule, draws");
  declare_grammar(inspect, line.inspect.grammar);
  inspect->add_flag("--json", line.inspect.json, "As JSON");
  inspect->callback([&line] { line.verb = [&line] { return inspect_verb(line.inspect); }; });

  CLI::App* reproduce = app.add_subcommand("reproduce", "Make a file anew from its own record, and compare");
  reproduce->add_option("file", line.reproduce.file, "Any model, picture or JSON that espalier wrote")->required();
  reproduce->add_option("--run", line.reproduce.run_folder, "Folder of its run, if the file was moved");
  declare_threads(reproduce, line.reproduce.threads);
  reproduce->callback([&line] { line.verb = [&line] { return reproduce_verb(line.reproduce); }; });

  CLI::App* exporting = app.add_subcommand("export", "Write a derivation's model in another format");
  ExportVerbOptions& o = line.export_;
  exporting->add_option("derivation", o.derivation, "A .derivation.json")->required();
  declare_grammar(exporting, o.grammar);
  declare_attributes(exporting, o.attributes);
  exporting->add_option("-o,--out", o.out, "File to write: .glb .obj .ply .stl")->required();
  declare_detail(exporting, o.detail);
  exporting->add_flag("--lods", o.detail.lods, "All four levels, as NAME-lod0.glb to NAME-lod3.glb, and a table of their triangles");
  exporting->callback([&line] { line.verb = [&line] { return export_verb(line.export_); }; });
}

void declare_render_camera(CLI::App* verb, RenderOptions& o) {
  verb->add_option("--size", o.size, "Width and height, of a frame: 1200x900 (turntables 400x300)");
  verb->add_option("--azimuth", o.azimuth, "Where the camera stands, degrees: 0 looks from +z, 90 from +x (35)");
  verb->add_option("--elevation", o.elevation, "How far above, degrees, -90 to 90 (22)");
  verb->add_option("--eye", o.eye, "Where the camera stands, metres: x,y,z; instead of azimuth, elevation and framing");
  verb->add_option("--at", o.at, "What it looks at: x,y,z (the middle of the model)");
  verb->add_option("--fov", o.fov, "Vertical angle of view, degrees (a long lens: 27 along the longer side)");
  verb->add_option("--tall", o.tall, "Parallel rays; the height of the picture in metres");
}

void declare_render(CLI::App& app, CommandLine& line) {
  CLI::App* verb = app.add_subcommand("render", "Draw a derivation's model: a picture, or a turntable");
  RenderOptions& o = line.render;
  verb->add_option("file", o.file, "A .derivation.json, a file made of one, or the folder of a run (its best)")
      ->required();
  declare_grammar(verb, o.grammar);
  declare_attributes(verb, o.attributes);
  verb->add_option("-o,--out", o.out, "Picture to write: .png");
  declare_render_camera(verb, o);
  verb->add_option("--samples", o.samples, "Samples per pixel at edges, 1 to 256 (16)");
  verb->add_option("--background", o.background, "One colour, \"#rrggbb\" (a light backdrop)");
  verb->add_flag("--transparent", o.transparent, "Alpha instead of a background; the ground's shadow stays");
  verb->add_flag("--no-ground", o.no_ground, "No ground and no shadow on it");
  verb->add_option("--view", o.view, "full, parts (what targets see without details), or bones (full)");
  declare_detail(verb, o.detail);
  verb->add_flag("--targets", o.targets, "The scene's meshes as ghosts, as in a run's best.png, and its curves over the model");
  verb->add_option("--turntable", o.turntable, "So many frames around the model, in one strip");
  verb->add_option("--columns", o.columns, "Columns of the strip (near to 4:3)");
  verb->add_option("--frames", o.frames, "Folder for the frames of a turntable: 0001.png ..");
  verb->add_option("--light", o.light, "The light of a turntable stays with the camera, or with the model (camera)");
  declare_threads(verb, o.threads);
  verb->callback([&line] { line.verb = [&line] { return render_verb(line.render); }; });
}

void declare_graph(CLI::App& app, CommandLine& line) {
  CLI::App* verb = app.add_subcommand("graph", "Draw a grammar's generator graph, or a derivation's tree, as SVG");
  GraphOptions& o = line.graph;
  verb->add_option("file", o.file, "Grammar file (.esp) or .derivation.json")->required();
  declare_grammar(verb, o.grammar);
  declare_attributes(verb, o.attributes);
  verb->add_option("-o,--out", o.out, "File to write: .svg (standard output)");
  verb->callback([&line] { line.verb = [&line] { return graph_verb(line.graph); }; });
}

void declare_explain(CLI::App& app, CommandLine& line) {
  CLI::App* verb = app.add_subcommand("explain", "Say what a grammar can make, how large and how likely");
  ExplainOptions& o = line.explain;
  verb->add_option("grammar", o.grammar, "Grammar file (.esp)")->required();
  declare_attributes(verb, o.attributes);
  verb->add_option("--samples", o.samples, "Models to draw, 1 to 100000 (1000)")->check(CLI::Range(1, 100'000));
  verb->add_option("--seed", o.seed, "Seed (1)")->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62));
  verb->add_flag("--json", o.json, "As JSON");
  verb->callback([&line] { line.verb = [&line] { return explain_verb(line.explain); }; });
}

void declare_breed(CLI::App& app, CommandLine& line) {
  CLI::App* verb = app.add_subcommand("breed", "Make many distinct siblings of a model, or kinds of a grammar");
  BreedOptions& o = line.breed;
  verb->add_option("--from", o.from, "Derivation (or model, picture, run's folder), grammar (.esp) or scene (.toml)")
      ->required();
  verb->add_option("-n,--count", o.count, "How many, 1 to 1000 (20)")->check(CLI::Range(1, 1000));
  verb->add_option("--max-triangles", o.most_triangles, "Of each file")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  verb->add_option("--strength", o.strength, "How far siblings stray, 0 to 1 (0.3)")->check(CLI::Range(0.0, 1.0));
  verb->add_option("--least-distance", o.least_distance, "Of the features of any two, 0 to 1 (0.01)")
      ->check(CLI::Range(0.0, 1.0));
  verb->add_option("--seed", o.seed, "Seed (1)")->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 62));
  verb->add_option("--format", o.format, "glb, obj, ply or stl (glb)");
  declare_detail(verb, o.detail);
  verb->add_flag("--lods", o.detail.lods, "All four levels, as NNN-lod0.glb to NNN-lod3.glb; --max-triangles is of lod0");
  declare_grammar(verb, o.grammar);
  declare_attributes(verb, o.attributes);
  declare_threads(verb, o.threads);
  verb->add_option("--out", o.out, "Folder to write (out/NAME-species)");
  verb->callback([&line] { line.verb = [&line] { return breed_verb(line.breed); }; });
}

void declare_studio(CLI::App& app, CommandLine& line) {
  CLI::App* verb = app.add_subcommand("studio", "Serve the editor: a page where you draw and the model follows");
  StudioOptions& o = line.studio;
  verb->add_option("project", o.project, "Name of a project, made if there is none; or a file to begin a new one with: a scene (.toml), "
                  "a grammar (.esp), a whole project (.espalier), the zip file of a scene folder");
  verb->add_option("--port", o.port, "Of 127.0.0.1; 0: any that is free (7411)");
  verb->add_flag("!--no-open", o.open, "Print the link, open no browser");
  verb->add_flag("--new-token", o.new_token, "Make a new link: those of earlier starts are not served any more");
  verb->add_option("--data", o.data, "SQLite file that projects are kept in (~/.local/share/espalier/studio.sqlite)");
  verb->add_option("--page", o.page, "Folder of the page (studio-page beside the program)");
  verb->callback([&line] { line.verb = [&line] { return studio_verb(line.studio); }; });
}

int main_verb(int argc, char** argv) {
  CLI::App app("Espalier: grammars that grow towards what you want.", "espalier");
  app.set_version_flag("--version", fmt::format("espalier {}", kVersion));
  app.footer(kExamples);
  app.require_subcommand(1);
  CommandLine line;
  declare_check(app, line);
  declare_format(app, line);
  declare_import(app, line);
  declare_sample(app, line);
  declare_breed(app, line);
  declare_run(app, line);
  declare_compare(app, line.compare, line.verb);
  declare_sweep(app, line.sweep, line.verb);
  declare_preview(app, line);
  declare_score(app, line);
  declare_file_verbs(app, line);
  declare_render(app, line);
  declare_similarity(app, line.similarity, line.verb);
  declare_graph(app, line);
  declare_explain(app, line);
  declare_studio(app, line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kBadInput;
  }
  return line.verb();
}

}  // namespace
}  // namespace espalier

int main(int argc, char** argv) {
  // A full disk or a closed pipe is an error to be told, not a death.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  std::string message;
  try {
    return espalier::main_verb(argc, argv);
  } catch (const espalier::Error& error) {
    message = error.what();
  } catch (const std::bad_alloc&) {
    message = "out of memory";
  } catch (const std::exception& error) {
    message = fmt::format("unexpected: {}", error.what());
  }
  std::fputs(fmt::format("espalier: {}\n", message).c_str(), stderr);  // fmt::print would throw where stderr is full
  return espalier::kBadInput;
}
