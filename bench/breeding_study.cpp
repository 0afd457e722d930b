// How many ratings it costs to breed a tree that somebody has in mind: a simulated user with a hidden favourite rates
// trees of grammars/gentree.esp. Writes tables for bench/experiments.
//
//   breeding_study --out DIR [--favourites N] [--first N] [--threads N] [--tune NAME=VALUE ...]
//
//   methods.csv   one line for each favourite, method and noise: ratings until a shown tree is close, 0 where none came
//                 within the cap; the best distance and the shape's distance at the end
//   curves.csv    the best distance shown so far, after every 20 ratings
//   shapes.csv    the distance of the favourite's shape to itself, by other random points, and to another viable tree's
//   variants.csv  GenTree's four variants with an editor, one simulated hour each
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "base/executor.h"
#include "breed/first_generation.h"
#include "breed/generation.h"
#include "breed/newcomer.h"
#include "breed/screen.h"
#include "breed/simulated_user.h"
#include "breed/usual_viability.h"
#include "breed/variation.h"
#include "io/file.h"
#include "io/mesh_import.h"
#include "model/shell.h"
#include "run/grammar_file.h"
#include "run/similarity.h"
#include "score/shape_descriptor.h"

namespace espalier {
namespace {

constexpr std::uint32_t kCap = 600, kRandomTrees = 100'000, kCurveStep = 20;
constexpr std::uint32_t kLargestShape = 50'000;  // parts of a model whose shape is described

struct Options {
  std::string out = "out/breeding";
  std::uint32_t favourites = 50, first = 0;  // settings were tuned with favourites from 1000 on
  int threads = 0;
  std::map<std::string, double> tuned;
  bool shapes = true;

  double value(const std::string& name, double otherwise) const {
    const auto found = tuned.find(name);
    return found == tuned.end() ? otherwise : found->second;
  }
};

enum class Method { random, classic, ours, taste };
constexpr const char* kMethods[] = {"random", "classic", "ours", "taste"};
constexpr struct {
  const char* name;
  double scale;  // of the Gumbel noise, in distance
} kNoises[] = {{"steady", 0.01}, {"wavering", 0.03}};

/// The bits of GenTree's 13 genes, 82 in all (reference: docs/breeding.md).
const std::vector<std::uint32_t> kGenTreeBits = {3, 3, 3, 3, 3, 3, 8, 8, 8, 8, 8, 8, 16};

/// What is bred, and who looks at it. Of one thread.
class Bench {
 public:
  explicit Bench(const LoadedGrammar& grammar) : graph_(grammar.graph), appraiser_(grammar.graph) {
    problem.graph = graph_;
    problem.appraiser = &appraiser_;
  }
  BreedProblem problem;

 private:
  std::shared_ptr<const GeneratorGraph> graph_;
  GenomeAppraiser appraiser_;  // a person sees trees of all kinds, also those that a real screen would pass over
};

/// A person at work: rates what is new, and knows the best that was shown.
class Session {
 public:
  Session(SimulatedUser& user, double close) : user_(user), close_(close) {}

  /// False where the cap is reached, or a close tree was shown.
  bool rate(std::vector<Member>& members, GenomeAppraiser* features) {
    for (Member& member : members) {
      if (member.rated) continue;
      if (done()) return false;
      ++ratings_;
      const double distance = user_.distance(member.derivation);
      if (distance < best_) best_ = distance, best_tree_ = member.derivation;
      member.rating = user_.rate(member.derivation);
      member.rated = true;
      if (features) {
        const Derivation* one[] = {&member.derivation};
        opinions.push_back({features->appraise(one)[0].features, member.rating});
      }
      if (ratings_ % kCurveStep == 0) curve.push_back(best_);
      if (distance < close_ && !needed_) needed_ = ratings_;
    }
    return !done();
  }
  bool done() const { return ratings_ >= kCap || needed_; }
  std::uint32_t ratings() const { return ratings_; }
  std::uint32_t needed() const { return needed_; }
  double best() const { return best_; }
  const Derivation& best_tree() const { return best_tree_; }

  std::vector<double> curve;
  std::vector<Opinion> opinions;

 private:
  SimulatedUser& user_;
  double close_, best_ = 1;
  Derivation best_tree_;
  std::uint32_t ratings_ = 0, needed_ = 0;
};

BreedSettings settings_of(Method method, const Options& options) {
  BreedSettings settings;
  if (method == Method::classic) {
    settings.method = BreedMethod::classic;
    settings.population = 20;
    settings.genesis.bits = kGenTreeBits;
  } else {
    settings.population = static_cast<std::uint32_t>(options.value("population", settings.population));
    settings.strength = options.value("strength", settings.strength);
    settings.keep = static_cast<std::uint32_t>(options.value("keep", settings.keep));
    settings.crossover = options.value("crossover", settings.crossover);
    settings.blend = options.value("blend", settings.blend);
    settings.lean = options.value("lean", settings.lean);
    settings.newcomers = options.value("newcomers", settings.newcomers);
  }
  return settings;
}

std::vector<Member> random_screen(const LoadedGrammar& grammar, std::uint64_t seed, std::uint32_t population) {
  std::vector<Member> members(population);
  for (std::uint32_t i = 0; i < population; ++i) {
    RandomStream random({seed, Purpose::test, 1, i, 0});
    members[i].id = i + 1;
    members[i].derivation = draw_newcomer(*grammar.graph, random);
  }
  return members;
}

/// A generation of these members after those before it, whose least ratings it notes.
std::vector<Member> bred(const BreedProblem& problem, const BreedSettings& settings, const std::vector<Member>& members,
                         std::uint32_t generation, MemberId next_id, std::deque<double>& worst_before) {
  const std::vector<double> worst(worst_before.begin(), worst_before.end());
  std::vector<Member> next = next_generation(problem, settings, members, generation, next_id, worst).members;
  double least = members[0].rating;
  for (const Member& member : members) least = std::min(least, member.rating);
  worst_before.push_front(least);
  return next;
}

void breed_until_close(Method method, const Options& options, const LoadedGrammar& grammar, std::uint64_t seed,
                       Session& session) {
  Bench bench(grammar);
  bench.problem.seed = seed;
  const BreedSettings settings = settings_of(method, options);
  GenomeAppraiser features(grammar.graph);
  if (method == Method::random) {
    for (std::uint32_t i = 0; !session.done(); ++i) {
      RandomStream random({seed, Purpose::test, 1, i, 0});
      std::vector<Member> one(1);
      one[0].derivation = draw_newcomer(*grammar.graph, random);
      session.rate(one, nullptr);
    }
    return;
  }
  ScreenSettings screen;
  screen.pool = static_cast<std::uint32_t>(options.value("pool", screen.pool));
  screen.rounds = static_cast<std::uint32_t>(options.value("rounds", screen.rounds));
  screen.daring = options.value("daring", screen.daring);
  screen.spacing = options.value("spacing", screen.spacing);
  TasteSettings taste_settings;
  taste_settings.noise = options.value("noise", taste_settings.noise);
  std::vector<Member> members;
  if (method == Method::classic) {  // GenTree's first trees are random
    members = random_screen(grammar, seed, settings.population);
  } else {
    members = first_generation(bench.problem, settings, {}, 1).members;
  }
  MemberId next_id = 1000;
  std::deque<double> worst_before;
  for (std::uint32_t generation = 1; generation < 2000; ++generation) {
    if (!session.rate(members, method == Method::taste ? &features : nullptr)) break;
    if (method == Method::taste) {
      const Taste taste(session.opinions, {}, taste_settings);
      members = next_screen(bench.problem, settings, screen, members, taste, generation, next_id).generation.members;
    } else {
      members = bred(bench.problem, settings, members, generation, next_id, worst_before);
    }
    next_id += members.size();
  }
}

/// The distance that the nearest 0.1 % of random trees are below.
double close_to(const LoadedGrammar& grammar, const SimulatedUser& user) {
  std::vector<double> distances;
  for (std::uint32_t i = 0; i < kRandomTrees; ++i) {
    RandomStream random({99, Purpose::test, 2, i, 0});
    distances.push_back(user.distance(draw_newcomer(*grammar.graph, random)));
  }
  const auto place = distances.begin() + kRandomTrees / 1000;
  std::nth_element(distances.begin(), place, distances.end());
  return *place;
}

/// A viable draw.
Derivation draw_favourite(const LoadedGrammar& grammar, const MeshTable& meshes, std::uint32_t which) {
  const auto executor = make_serial_executor();
  ModelAppraiser::Settings settings;
  settings.viability = usual_viability(*grammar.graph, meshes);
  ModelAppraiser appraiser(grammar.graph, meshes, settings, nullptr, *executor);
  for (std::uint32_t i = 0; i < 1000; ++i) {
    RandomStream random({77, Purpose::test, which, i, 0});
    const Derivation drawn = draw_newcomer(*grammar.graph, random);
    const Derivation* one[] = {&drawn};
    if (appraiser.appraise(one)[0].viable) return drawn;
  }
  throw Error("no viable tree among 1000");
}

/// Median distance of subdivided D2 over the voxels with surface.
double shape_distance(const LoadedGrammar& grammar, const MeshTable& meshes, const Derivation& a, const Derivation& b,
                      std::uint32_t draw = 0) {
  ExpandLimits limits;
  limits.most_parts = kLargestShape;
  limits.make_materials = false;
  Expander expander(*grammar.graph, limits);
  const auto executor = make_serial_executor();
  Model model;
  const auto described = [&](const Derivation& derivation, std::uint32_t points) {
    expander.expand(derivation, ExpandTo::full, model);
    const Shell shell = shell_of(model, meshes);
    DescriptorSettings settings;
    settings.draw = points;
    return describe(shell, Subdivision(bounds(shell), settings.layers), settings, *executor);
  };
  return median(distance(described(a, 0), described(b, draw)), VoxelChoice::occupied);
}

/// What the distances of shapes are to be held against: the favourite's to itself by other random points of the
/// surface, and to another viable tree.
std::string shapes_of(std::uint32_t which, const Derivation& favourite, const LoadedGrammar& grammar,
                      const MeshTable& meshes) {
  const Derivation other = draw_favourite(grammar, meshes, which + 500'000);
  return fmt::format("{},{:.5f},{:.5f}\n", which, shape_distance(grammar, meshes, favourite, favourite, 1),
                     shape_distance(grammar, meshes, favourite, other));
}

struct MethodRow {
  std::string line, curve;
};

MethodRow run_method(Method method, std::size_t noise, std::uint32_t which, const Derivation& favourite, double close,
                     const Options& options, const LoadedGrammar& grammar, const MeshTable& meshes) {
  const std::uint64_t seed = 1000 + which;
  SimulatedUser user(*grammar.graph, favourite, kNoises[noise].scale, seed);
  Session session(user, close);
  breed_until_close(method, options, grammar, seed, session);
  const char* name = kMethods[static_cast<int>(method)];
  const double shape =
      options.shapes ? shape_distance(grammar, meshes, session.best_tree(), favourite) : 0;
  MethodRow row;
  row.line = fmt::format("{},{},{},{},{:.5f},{:.5f},{:.5f}\n", which, name, kNoises[noise].name, session.needed(),
                         close, session.best(), shape);
  for (std::size_t i = 0; i < session.curve.size(); ++i) {
    row.curve += fmt::format("{},{},{},{},{:.5f}\n", which, name, kNoises[noise].name, (i + 1) * kCurveStep,
                             session.curve[i]);
  }
  return row;
}

/// Moves one of the tree's three worst parameters half-way to the favourite's.
void edit(const GeneratorGraph& graph, const Derivation& favourite, SimulatedUser& user, Derivation& tree) {
  const std::vector<DrawComponent>& draws = graph.rules[graph.start()].draws;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < draws.size(); ++i) order.push_back(i);
  const auto apart = [&](std::size_t i) { return std::abs(static_cast<double>(tree.draws[i]) - favourite.draws[i]); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return apart(a) > apart(b); });
  const std::size_t worst = order[user.random().below(3)];
  tree.draws[worst] = static_cast<std::uint32_t>((std::uint64_t{tree.draws[worst]} + favourite.draws[worst]) / 2);
}

/// One generation of GenTree's variants (Congdon and Mazza 2003, section 4.3), seconds that it took: 9 for each
/// rating, of new trees alone, and 36 for each edited tree, its new rating included. Variant 2 edits all trees,
/// variant 4 the better half of what it rated: that makes the paper's 26 s per tree.
double attend(int variant, const GeneratorGraph& graph, const Derivation& favourite, SimulatedUser& user,
              std::vector<Member>& members) {
  constexpr double kEdit = 36, kRate = 9;
  double seconds = 0;
  const auto rate = [&](Member& member) {
    member.rating = user.rate(member.derivation);
    member.rated = true;
  };
  if (variant >= 3) {
    for (Member& member : members) {
      if (member.rated) continue;
      rate(member);
      seconds += kRate;
    }
  }
  if (variant == 2 || variant == 4) {
    std::vector<Member*> edited;
    for (Member& member : members) edited.push_back(&member);
    std::stable_sort(edited.begin(), edited.end(), [](auto* a, auto* b) { return a->rating > b->rating; });
    if (variant == 4) edited.resize(edited.size() / 2);
    for (Member* member : edited) {
      edit(graph, favourite, user, member->derivation);
      if (variant == 4) rate(*member);
      seconds += kEdit;
    }
  }
  return seconds;
}

/// A simulated hour of a variant; of variant 1, which asks for nothing, 20 generations.
std::string run_variant(int variant, std::uint32_t which, const Derivation& favourite, const LoadedGrammar& grammar) {
  constexpr double kHour = 3600;
  constexpr std::uint32_t kIdleGenerations = 20, kMostGenerations = 1000;
  Bench bench(grammar);
  bench.problem.seed = 5000 + which;
  SimulatedUser user(*grammar.graph, favourite, kNoises[0].scale, bench.problem.seed);
  BreedSettings settings = settings_of(Method::classic, {});
  settings.use_ratings = variant >= 3;
  settings.genesis.elitism = settings.use_ratings;  // else nobody is best
  std::vector<Member> members = random_screen(grammar, bench.problem.seed, settings.population);
  double seconds = 0, best = 1;
  std::uint32_t generations = 0;
  std::deque<double> worst_before;
  for (MemberId next_id = 1000; generations < (variant == 1 ? kIdleGenerations : kMostGenerations); next_id += 20) {
    std::vector<Member> attended = members;
    seconds += attend(variant, *grammar.graph, favourite, user, attended);
    if (seconds > kHour) break;
    members = std::move(attended);
    for (const Member& member : members) best = std::min(best, user.distance(member.derivation));
    ++generations;
    members = bred(bench.problem, settings, members, generations, next_id, worst_before);
  }
  double apart = 0, pairs = 0, mean = 0;
  for (std::size_t i = 0; i < members.size(); ++i) {
    mean += user.distance(members[i].derivation) / static_cast<double>(members.size());
    for (std::size_t j = 0; j < i; ++j) {
      apart += gene_distance(*grammar.graph, members[i].derivation, members[j].derivation);
      ++pairs;
    }
  }
  return fmt::format("{},{},{},{:.5f},{:.5f},{:.5f}\n", which, variant, generations, best, mean, apart / pairs);
}

int study(const Options& options) {
  const LoadedGrammar grammar = load_grammar(std::string(ESPALIER_SOURCE_DIR) + "/grammars/gentree.esp", {});
  AssimpMeshSource source;
  const MeshTable meshes = load_meshes(grammar, source);
  const auto executor = make_tbb_executor(options.threads);
  constexpr std::size_t kKinds = std::size(kMethods) * std::size(kNoises);
  std::vector<MethodRow> rows(options.favourites * kKinds);
  std::vector<std::string> variants(options.favourites * 4), shapes(options.favourites);
  executor->for_each(options.favourites, [&](std::size_t f, int) {
    const auto which = options.first + static_cast<std::uint32_t>(f);
    const Derivation favourite = draw_favourite(grammar, meshes, which);
    const double close = close_to(grammar, SimulatedUser(*grammar.graph, favourite, 0, 0));
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
      const auto method = static_cast<Method>(kind / std::size(kNoises));
      rows[f * kKinds + kind] =
          run_method(method, kind % std::size(kNoises), which, favourite, close, options, grammar, meshes);
    }
    if (options.shapes) shapes[f] = shapes_of(which, favourite, grammar, meshes);
    for (int variant = 1; variant <= 4; ++variant) {
      variants[f * 4 + static_cast<std::size_t>(variant - 1)] = run_variant(variant, which, favourite, grammar);
    }
  });
  std::string methods = "favourite,method,noise,ratings,close,best,shape\n";
  std::string curves = "favourite,method,noise,ratings,best\n";
  for (const MethodRow& row : rows) methods += row.line, curves += row.curve;
  std::string lines = "favourite,variant,generations,best,mean,diversity\n";
  for (const std::string& line : variants) lines += line;
  std::string shape_lines = "favourite,anew,other\n";
  for (const std::string& line : shapes) shape_lines += line;
  std::filesystem::create_directories(options.out);
  write_file(options.out + "/shapes.csv", shape_lines);
  write_file(options.out + "/methods.csv", methods);
  write_file(options.out + "/curves.csv", curves);
  write_file(options.out + "/variants.csv", lines);
  return 0;
}

Options parse(int count, char** words) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--no-shapes") {
      options.shapes = false;
      continue;
    }
    if (i + 1 == count) throw Error(word + " needs a value");
    const std::string value = words[++i];
    if (word == "--out") {
      options.out = value;
    } else if (word == "--favourites") {
      options.favourites = static_cast<std::uint32_t>(std::stoul(value));
    } else if (word == "--first") {
      options.first = static_cast<std::uint32_t>(std::stoul(value));
    } else if (word == "--threads") {
      options.threads = std::stoi(value);
    } else if (word == "--tune" && value.find('=') != std::string::npos) {
      options.tuned[value.substr(0, value.find('='))] = std::stod(value.substr(value.find('=') + 1));
    } else {
      throw Error("no such option: " + word);
    }
  }
  return options;
}

}  // namespace
}  // namespace espalier

int main(int count, char** words) {
  try {
    return espalier::study(espalier::parse(count, words));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "breeding_study: %s\n", error.what());
    return 2;
  }
}
