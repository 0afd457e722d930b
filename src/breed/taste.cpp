#include "breed/taste.h"

#include <algorithm>
#include <cmath>
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

Matrix covariance(const Matrix& points, double length, double noise) {
  Matrix k(points.cols(), points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) k(i, j) = k(j, i) = kernel(squared_distance(points, i, j), length);
    k(i, i) = 1 + noise * noise;
  }
  return k;
}

/// log p(ratings | points, length), but for a constant.
double likelihood(const Matrix& points, const Vector& ratings, double length, double noise) {
  const Eigen::LLT<Matrix> factor(covariance(points, length, noise));
  double log_diagonal = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) log_diagonal += natural_log(factor.matrixL()(i, i));
  return -0.5 * ratings.dot(factor.solve(ratings)) - log_diagonal;
}

std::vector<Opinion> all_opinions(const std::vector<Opinion>& opinions, const std::vector<Comparison>& comparisons) {
  std::vector<Opinion> all = opinions;
  for (const Comparison& comparison : comparisons) {
    all.push_back({comparison.better, 0.5});
    all.push_back({comparison.worse, -0.5});
  }
  return all;
}

void check(const std::vector<Opinion>& opinions) {
  if (opinions.empty()) throw Error("a model of taste needs at least one opinion, got none");
  const std::size_t size = opinions[0].features.size();
  if (size == 0) throw Error("a model of taste needs features, got none");
  for (const Opinion& opinion : opinions) {
    if (opinion.features.size() != size) {
      throw Error(fmt::format("opinions must have {} features each, got {}", size, opinion.features.size()));
    }
    bool finite = std::isfinite(opinion.rating);
    for (const double feature : opinion.features) finite = finite && std::isfinite(feature);
    if (!finite) throw Error("ratings and features must be finite");
  }
}

}  // namespace

struct Taste::Model {
  Vector mean_feature, feature_scale;  // of the opinions: features are standardised
  double mean_rating = 0, spread = 1;
  Matrix points;                       // [feature][opinion], standardised
  double length = 1, noise = 1;
  Eigen::LLT<Matrix> factor;
  Vector weights;

  Vector standardised(const std::vector<double>& features) const {
    CHECK(static_cast<Eigen::Index>(features.size()) == mean_feature.size());
    return (Eigen::Map<const Vector>(features.data(), mean_feature.size()) - mean_feature).cwiseProduct(feature_scale);
  }
  Vector kernel_to(const Vector& point) const {
    Vector k(points.cols());
    for (Eigen::Index i = 0; i < points.cols(); ++i) k[i] = kernel((points.col(i) - point).squaredNorm(), length);
    return k;
  }
};

void validate(const TasteSettings& s) {
  if (!(s.noise > 0 && s.noise <= 10)) throw Error(fmt::format("noise must be above 0 and at most 10, got {}", s.noise));
  require_range<std::size_t>("most_opinions", s.most_opinions, 1, 2000);
}

Taste::~Taste() = default;
Taste::Taste(Taste&&) noexcept = default;
Taste& Taste::operator=(Taste&&) noexcept = default;

Taste::Taste(const std::vector<Opinion>& opinions, const std::vector<Comparison>& comparisons,
             const TasteSettings& settings)
    : model_(std::make_unique<Model>()) {
  validate(settings);
  std::vector<Opinion> all = all_opinions(opinions, comparisons);
  check(all);
  if (all.size() > settings.most_opinions) {
    all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(settings.most_opinions));
  }
  // Sums depend on their order: in this one they do not depend on the person's.
  std::sort(all.begin(), all.end(), [](const Opinion& a, const Opinion& b) {
    return a.features != b.features ? a.features < b.features : a.rating < b.rating;
  });
  Model& m = *model_;
  const auto n = static_cast<Eigen::Index>(all.size()), d = static_cast<Eigen::Index>(all[0].features.size());
  m.points.resize(d, n);
  Vector ratings(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Opinion& opinion = all[static_cast<std::size_t>(i)];
    m.points.col(i) = Eigen::Map<const Vector>(opinion.features.data(), d);
    ratings[i] = opinion.rating;
  }
  m.mean_feature = m.points.rowwise().mean();
  m.feature_scale.resize(d);
  for (Eigen::Index f = 0; f < d; ++f) {
    const double variance = (m.points.row(f).array() - m.mean_feature[f]).square().mean();
    // What hardly ever changed is not blown up: features are about 0..1.
    m.feature_scale[f] = 1 / std::max(std::sqrt(variance), 0.02);
  }
  m.points = (m.points.colwise() - m.mean_feature).array().colwise() * m.feature_scale.array();
  m.mean_rating = ratings.mean();
  ratings.array() -= m.mean_rating;
  m.spread = std::sqrt(ratings.array().square().mean());
  if (!(m.spread > 0)) m.spread = 1;
  ratings /= m.spread;
  m.noise = settings.noise;

  // Evenly out of the sorted list, where there are many.
  const Eigen::Index step = (n + static_cast<Eigen::Index>(kMostForScales) - 1) / static_cast<Eigen::Index>(kMostForScales);
  const Eigen::Index few = (n + step - 1) / step;
  Matrix some(d, few);
  Vector some_ratings(few);
  for (Eigen::Index i = 0; i < few; ++i) some.col(i) = m.points.col(i * step), some_ratings[i] = ratings[i * step];
  const double median = median_distance(some);
  double best = 0;
  for (const double scale : kScales) {
    const double value = likelihood(some, some_ratings, scale * median, m.noise);
    if (scale != kScales[0] && value <= best) continue;
    best = value;
    m.length = scale * median;
  }
  m.factor.compute(covariance(m.points, m.length, m.noise));
  m.weights = m.factor.solve(ratings);
}

std::size_t Taste::opinions() const { return static_cast<std::size_t>(model_->points.cols()); }

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
      text += fmt::format("{}{} {}", said++ ? ", " : "", point[static_cast<Eigen::Index>(f)] > 0 ? "more" : "less", names[f]);
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
