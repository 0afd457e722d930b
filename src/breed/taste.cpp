#include "breed/taste.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "base/natural_exp.h"
#include "base/natural_log.h"
#include "search/require.h"

namespace espalier {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

// Of the median distance between opinions. Taste mostly goes one way over the range of a feature, so long scales win.
constexpr double kScales[] = {0.5, 1, 2, 4};
constexpr std::size_t kMostForScales = 150;  // opinions that the scale is chosen with

double squared_distance(const Matrix& points, Eigen::Index i, Eigen::Index j) {
  return (points.col(i) - points.col(j)).squaredNorm();
}

/// Of the upper triangle.
double median_distance(const Matrix& points) {
  std::vector<double> distances;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) distances.push_back(std::sqrt(squared_distance(points, i, j)));
  }
  if (distances.empty()) return 1;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle > 0 ? *middle : 1;
}

double kernel(double squared, double length) { return natural_exp(-squared / (2 * length * length)); }

/// What was said: that a point has a rating, or that the difference of two points is `value`. All standardised.
struct Saying {
  Eigen::Index point = 0, less = -1;  // less: the point that is taken away; -1: none
  double value = 0;
};

/// Covariance of two sayings, of the covariances of their points.
template <typename OfPoints>
double covariance_of(const Saying& a, const Saying& b, OfPoints of_points) {
  double k = of_points(a.point, b.point);
  if (a.less >= 0) k -= of_points(a.less, b.point);
  if (b.less >= 0) k -= of_points(a.point, b.less);
  if (a.less >= 0 && b.less >= 0) k += of_points(a.less, b.less);
  return k;
}

Eigen::LLT<Matrix> factor_of(const Matrix& points, const std::vector<Saying>& sayings, double length, double noise) {
  Matrix of_points(points.cols(), points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      of_points(i, j) = of_points(j, i) = kernel(squared_distance(points, i, j), length);
    }
  }
  const auto n = static_cast<Eigen::Index>(sayings.size());
  Matrix k(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      k(i, j) = k(j, i) = covariance_of(sayings[static_cast<std::size_t>(i)], sayings[static_cast<std::size_t>(j)],
                                        [&](Eigen::Index a, Eigen::Index b) { return of_points(a, b); });
    }
    k(i, i) += noise * noise;
  }
  return Eigen::LLT<Matrix>(k);
}

Vector values_of(const std::vector<Saying>& sayings) {
  Vector values(static_cast<Eigen::Index>(sayings.size()));
  for (std::size_t i = 0; i < sayings.size(); ++i) values[static_cast<Eigen::Index>(i)] = sayings[i].value;
  return values;
}

/// log p(what was said | points, length), but for a constant.
double likelihood(const Matrix& points, const std::vector<Saying>& sayings, double length, double noise) {
  const Eigen::LLT<Matrix> factor = factor_of(points, sayings, length, noise);
  const Vector values = values_of(sayings);
  double log_diagonal = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) log_diagonal += natural_log(factor.matrixL()(i, i));
  return -0.5 * values.dot(factor.solve(values)) - log_diagonal;
}

template <typename T>
void keep_latest(std::vector<T>& list, std::size_t most) {
  if (list.size() > most) list.erase(list.begin(), list.end() - static_cast<std::ptrdiff_t>(most));
}

void check(const std::vector<Opinion>& opinions, const std::vector<Comparison>& comparisons) {
  if (opinions.empty() && comparisons.empty()) throw Error("a model of taste needs at least one opinion, got none");
  const std::size_t size = opinions.empty() ? comparisons[0].better.size() : opinions[0].features.size();
  if (size == 0) throw Error("a model of taste needs features, got none");
  const auto check_features = [&](const std::vector<double>& features) {
    if (features.size() != size) {
      throw Error(fmt::format("opinions must have {} features each, got {}", size, features.size()));
    }
    const bool finite = std::all_of(features.begin(), features.end(), [](double f) { return std::isfinite(f); });
    if (!finite) throw Error("ratings and features must be finite");
  };
  for (const Opinion& opinion : opinions) {
    check_features(opinion.features);
    if (!std::isfinite(opinion.rating)) throw Error("ratings and features must be finite");
  }
  for (const Comparison& comparison : comparisons) check_features(comparison.better), check_features(comparison.worse);
}

}  // namespace

struct Taste::Model {
  Vector mean_feature, feature_scale;  // of the points: features are standardised
  double mean_rating = 0, spread = 1;
  Matrix points;                       // [feature][point], standardised
  std::vector<Saying> sayings;
  double length = 1;
  Eigen::LLT<Matrix> factor;
  Vector weights;

  Vector standardised(const std::vector<double>& features) const {
    CHECK(static_cast<Eigen::Index>(features.size()) == mean_feature.size());
    return (Eigen::Map<const Vector>(features.data(), mean_feature.size()) - mean_feature).cwiseProduct(feature_scale);
  }
  void standardise() {
    mean_feature = points.rowwise().mean();
    feature_scale.resize(points.rows());
    for (Eigen::Index f = 0; f < points.rows(); ++f) {
      const double variance = (points.row(f).array() - mean_feature[f]).square().mean();
      // What hardly ever changed is not blown up: features are about 0..1.
      feature_scale[f] = 1 / std::max(std::sqrt(variance), 0.02);
    }
    points = (points.colwise() - mean_feature).array().colwise() * feature_scale.array();
  }
  /// Covariances of what was said with the rating of a point.
  Vector kernel_to(const Vector& point) const {
    Vector of_points(points.cols()), k(static_cast<Eigen::Index>(sayings.size()));
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      of_points[i] = kernel((points.col(i) - point).squaredNorm(), length);
    }
    for (std::size_t i = 0; i < sayings.size(); ++i) {
      const double less = sayings[i].less >= 0 ? of_points[sayings[i].less] : 0;
      k[static_cast<Eigen::Index>(i)] = of_points[sayings[i].point] - less;
    }
    return k;
  }
  void choose_length(double noise) {
    // Evenly out of the sorted list, where there are many.
    const std::size_t step = (sayings.size() + kMostForScales - 1) / kMostForScales;
    std::vector<Saying> some;
    for (std::size_t i = 0; i < sayings.size(); i += step) some.push_back(sayings[i]);
    const double median = median_distance(points);
    double best = 0;
    for (const double scale : kScales) {
      const double value = likelihood(points, some, scale * median, noise);
      if (scale != kScales[0] && value <= best) continue;
      best = value;
      length = scale * median;
    }
  }
};

void validate(const TasteSettings& s) {
  if (!(s.noise > 0 && s.noise <= 10)) {
    throw Error(fmt::format("noise must be above 0 and at most 10, got {}", s.noise));
  }
  require_range<std::size_t>("most_opinions", s.most_opinions, 1, 2000);
}

Taste::~Taste() = default;
Taste::Taste(Taste&&) noexcept = default;
Taste& Taste::operator=(Taste&&) noexcept = default;

Taste::Taste(const std::vector<Opinion>& opinions, const std::vector<Comparison>& comparisons,
             const TasteSettings& settings)
    : model_(std::make_unique<Model>()) {
  // Sums depend on their order, and Eigen's on the sizes of the processor's caches: these are now everybody's.
  static std::once_flag once;
  std::call_once(once, [] { Eigen::setCpuCacheSizes(32 << 10, 256 << 10, 2 << 20); });
  validate(settings);
  check(opinions, comparisons);
  std::vector<Opinion> rated = opinions;
  std::vector<Comparison> compared = comparisons;
  keep_latest(rated, settings.most_opinions);
  keep_latest(compared, settings.most_opinions);
  // So that sums do not depend on the order of a person's words.
  std::sort(rated.begin(), rated.end(), [](const Opinion& a, const Opinion& b) {
    return a.features != b.features ? a.features < b.features : a.rating < b.rating;
  });
  std::sort(compared.begin(), compared.end(), [](const Comparison& a, const Comparison& b) {
    return a.better != b.better ? a.better < b.better : a.worse < b.worse;
  });

  Model& m = *model_;
  const std::size_t features = rated.empty() ? compared[0].better.size() : rated[0].features.size();
  m.points.resize(static_cast<Eigen::Index>(features), static_cast<Eigen::Index>(rated.size() + 2 * compared.size()));
  Eigen::Index next = 0;
  const auto add = [&](const std::vector<double>& point) {
    m.points.col(next) = Eigen::Map<const Vector>(point.data(), m.points.rows());
    return next++;
  };
  for (const Opinion& opinion : rated) m.mean_rating += opinion.rating / static_cast<double>(rated.size());
  double square = 0;
  for (const Opinion& opinion : rated) square += (opinion.rating - m.mean_rating) * (opinion.rating - m.mean_rating);
  if (square > 0) m.spread = std::sqrt(square / static_cast<double>(rated.size()));
  for (const Opinion& opinion : rated) {
    m.sayings.push_back({add(opinion.features), -1, (opinion.rating - m.mean_rating) / m.spread});
  }
  for (const Comparison& comparison : compared) {
    const Eigen::Index better = add(comparison.better), worse = add(comparison.worse);
    m.sayings.push_back({better, worse, 1});
  }
  m.standardise();
  m.choose_length(settings.noise);
  m.factor = factor_of(m.points, m.sayings, m.length, settings.noise);
  m.weights = m.factor.solve(values_of(m.sayings));
}

std::size_t Taste::opinions() const { return model_->sayings.size(); }

Forecast Taste::forecast(const std::vector<double>& features) const {
  const Model& m = *model_;
  const Vector k = m.kernel_to(m.standardised(features));
  const double explained = m.factor.matrixL().solve(k).squaredNorm();
  return {m.mean_rating + m.spread * k.dot(m.weights), m.spread * std::sqrt(std::max(0.0, 1 - explained))};
}

std::vector<Forecast> Taste::forecasts(const std::vector<std::vector<double>>& features) const {
  std::vector<Forecast> all;
  for (const std::vector<double>& one : features) all.push_back(forecast(one));
  return all;
}

std::vector<double> Taste::contributions(const std::vector<double>& features) const {
  const Model& m = *model_;
  const Vector point = m.standardised(features);
  const double usual = m.kernel_to(Vector::Zero(point.size())).dot(m.weights);
  std::vector<double> contributions;
  for (Eigen::Index f = 0; f < point.size(); ++f) {
    Vector moved = Vector::Zero(point.size());
    moved[f] = point[f];
    contributions.push_back(m.spread * (m.kernel_to(moved).dot(m.weights) - usual));
  }
  return contributions;
}

std::string Taste::reasons(const std::vector<double>& features, const std::vector<std::string>& names,
                           std::size_t most) const {
  CHECK(names.size() == features.size());
  const std::vector<double> gains = contributions(features);
  const Vector point = model_->standardised(features);
  std::vector<std::size_t> order(gains.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return std::abs(gains[a]) > std::abs(gains[b]); });
  const auto list = [&](bool liked) {
    std::string text;
    std::size_t said = 0;
    for (const std::size_t f : order) {
      if (said == most || std::abs(gains[f]) < 0.1 * model_->spread) break;
      if ((gains[f] > 0) != liked) continue;
      const char* const way = point[static_cast<Eigen::Index>(f)] > 0 ? "more" : "less";
      text += fmt::format("{}{} {}", said++ ? ", " : "", way, names[f]);
    }
    return text;
  };
  const std::string likes = list(true), dislikes = list(false);
  std::string text;
  if (!likes.empty()) text = "you like: " + likes;
  if (!dislikes.empty()) text += (text.empty() ? "you dislike: " : "; you dislike: ") + dislikes;
  return text;
}

}  // namespace espalier
