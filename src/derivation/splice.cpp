#include "derivation/splice.h"

#include <cstring>

#include "base/check.h"

namespace espalier {
namespace {

template <class T>
void copy(T* to, const T* from, std::size_t n) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (n > 0) std::memcpy(static_cast<void*>(to), from, n * sizeof(T));
}

/// child = host[0, begin) + donor[from, from + inserted) + host[begin + removed, end)
template <class T>
void splice_array(const std::vector<T>& host, std::size_t begin, std::size_t removed, const std::vector<T>& donor,
                  std::size_t from, std::size_t inserted, std::vector<T>& child) {
  child.resize(host.size() - removed + inserted);
  copy(child.data(), host.data(), begin);
  copy(child.data() + begin, donor.data() + from, inserted);
  copy(child.data() + begin + inserted, host.data() + begin + removed, host.size() - begin - removed);
}

template <class T>
void splice_array_in_place(std::vector<T>& host, std::size_t begin, std::size_t removed, const std::vector<T>& donor,
                           std::size_t from, std::size_t inserted) {
  const std::size_t tail = host.size() - begin - removed;
  if (inserted > removed) host.resize(host.size() + inserted - removed);
  if (tail > 0) {
    std::memmove(static_cast<void*>(host.data() + begin + inserted), host.data() + begin + removed, tail * sizeof(T));
  }
  copy(host.data() + begin, donor.data() + from, inserted);
  host.resize(begin + inserted + tail);
}

void shift_counts(const SubtreeSlice& removed, const SubtreeSlice& inserted, std::span<const PathStep> above,
                  Derivation& child) {
  for (const PathStep& step : above) {
    GeneRecord& record = child.genes[step.gene.gene];
    record.genes_below += inserted.genes - removed.genes;  // modulo 2^32: right for losses too
    record.slots_below += inserted.slots - removed.slots;
    record.draws_below += inserted.draws - removed.draws;
  }
}

}  // namespace

void splice(const Derivation& host, const SubtreeSlice& removed, const Derivation& donor, const SubtreeSlice& inserted,
            std::span<const PathStep> above, Derivation& child) {
  DCHECK(&child != &host && &child != &donor);
  splice_array(host.genes, removed.begin.gene, removed.genes, donor.genes, inserted.begin.gene, inserted.genes,
               child.genes);
  splice_array(host.slots, removed.begin.slot, removed.slots, donor.slots, inserted.begin.slot, inserted.slots,
               child.slots);
  splice_array(host.draws, removed.begin.draw, removed.draws, donor.draws, inserted.begin.draw, inserted.draws,
               child.draws);
  child.detail_seed = host.detail_seed;
  shift_counts(removed, inserted, above, child);
}

void splice_in_place(Derivation& host, const SubtreeSlice& removed, const Derivation& donor,
                     const SubtreeSlice& inserted, std::span<const PathStep> above) {
  DCHECK(&host != &donor);
  splice_array_in_place(host.genes, removed.begin.gene, removed.genes, donor.genes, inserted.begin.gene,
                        inserted.genes);
  splice_array_in_place(host.slots, removed.begin.slot, removed.slots, donor.slots, inserted.begin.slot,
                        inserted.slots);
  splice_array_in_place(host.draws, removed.begin.draw, removed.draws, donor.draws, inserted.begin.draw,
                        inserted.draws);
  shift_counts(removed, inserted, above, host);
}

SubtreeSlice whole(const Derivation& derivation) {
  return {{},
          static_cast<std::uint32_t>(derivation.genes.size()),
          static_cast<std::uint32_t>(derivation.slots.size()),
          static_cast<std::uint32_t>(derivation.draws.size())};
}

}  // namespace espalier
