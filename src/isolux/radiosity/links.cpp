#include "isolux/radiosity/links.h"

#include <algorithm>

namespace isolux {

/// Where the site's number stands in the hash table, or would.
std::size_t SiteTable::slot_of(const Site& site) const {
  std::uint64_t key = site.surface;
  for (const VertexId v : site.vertices) {
    key = (key ^ v) * 0x9e3779b97f4a7c15u;
    key ^= key >> 32;
  }
  std::size_t slot = key & (slots_.size() - 1);
  while (slots_[slot] > 0 && sites_[slots_[slot] - 1] != site) {
    slot = (slot + 1) & (slots_.size() - 1);
  }
  return slot;
}

std::optional<std::uint32_t> SiteTable::find(const Site& site) const {
  if (slots_.empty()) return std::nullopt;
  const std::uint32_t entry = slots_[slot_of(site)];
  if (entry == 0) return std::nullopt;
  return entry - 1;
}

std::uint32_t SiteTable::add(const Site& site) {
  if (2 * sites_.size() >= slots_.size()) grow();
  std::uint32_t& entry = slots_[slot_of(site)];
  if (entry == 0) {
    sites_.push_back(site);
    entry = static_cast<std::uint32_t>(sites_.size());
  }
  return entry - 1;
}

void SiteTable::grow() {
  constexpr std::size_t kFewest = 1024;
  slots_.assign(std::max(kFewest, 2 * slots_.size()), 0);
  for (std::size_t i = 0; i < sites_.size(); ++i) {
    slots_[slot_of(sites_[i])] = static_cast<std::uint32_t>(i + 1);
  }
}

}  // namespace isolux
