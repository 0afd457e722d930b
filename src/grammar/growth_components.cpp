// Strongly connected components of the graph of rules.

#include <algorithm>

#include "grammar/growth.h"

namespace espalier {
namespace {

constexpr std::size_t kUnseen = static_cast<std::size_t>(-1);

/// Tarjan's algorithm (1972), with a path of its own in place of recursion.
class ComponentFinder {
 public:
  ComponentFinder(const CheckContext& context, const std::vector<char>& left_out)
      : context_(context),
        left_out_(left_out),
        order_(left_out.size(), kUnseen),
        low_(left_out.size(), 0),
        next_term_(left_out.size(), 0),
        on_stack_(left_out.size(), false) {}

  std::vector<std::vector<std::size_t>> run() {
    for (std::size_t root = 0; root < left_out_.size(); ++root)
      if (order_[root] == kUnseen && !left_out_[root]) explore(root);
    return std::move(found_);
  }

 private:
  void open(std::size_t rule) {
    order_[rule] = low_[rule] = clock_++;
    on_stack_[rule] = true;
    stack_.push_back(rule);
    path_.push_back(rule);
  }

  void explore(std::size_t root) {
    open(root);
    while (!path_.empty()) {
      const std::size_t rule = path_.back();
      if (next_term_[rule] < context_.spawns[rule].size()) {
        const std::size_t child = context_.spawns[rule][next_term_[rule]++].child;
        if (left_out_[child]) continue;
        if (order_[child] == kUnseen) open(child);
        else if (on_stack_[child]) low_[rule] = std::min(low_[rule], order_[child]);
        continue;
      }
      path_.pop_back();
      if (!path_.empty()) low_[path_.back()] = std::min(low_[path_.back()], low_[rule]);
      if (low_[rule] == order_[rule]) close(rule);
    }
  }

  /// Takes the component of which `rule` was seen first off the stack.
  void close(std::size_t rule) {
    std::vector<std::size_t> component;
    do {
      component.push_back(stack_.back());
      on_stack_[stack_.back()] = false;
      stack_.pop_back();
    } while (component.back() != rule);
    std::sort(component.begin(), component.end());
    found_.push_back(std::move(component));
  }

  const CheckContext& context_;
  const std::vector<char>& left_out_;
  std::vector<std::size_t> order_, low_, next_term_;
  std::vector<char> on_stack_;
  std::vector<std::size_t> stack_{}, path_{};
  std::vector<std::vector<std::size_t>> found_{};
  std::size_t clock_ = 0;
};

}  // namespace

std::vector<GrowthCheck::Rules> GrowthCheck::components(const std::vector<char>& left_out) const {
  return ComponentFinder(context_, left_out).run();
}

}  // namespace espalier
