#include "trajet/sim/piece_index.hpp"

#include <algorithm>

namespace trajet {

PieceIndex::PieceIndex(const std::vector<RecordedPiece>& pieces, double direction) : direction_(direction) {
  begins_.reserve(pieces.size());
  for (const RecordedPiece& piece : pieces) begins_.push_back(direction * piece.from);
  if (begins_.empty()) return;
  const double span = direction * pieces.back().to - begins_.front();
  if (span > 0.0) scale_ = static_cast<double>(begins_.size()) / span;
  first_.assign(begins_.size() + 1, 0);
  for (const double begin : begins_) ++first_[slot(begin) + 1];
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

std::size_t PieceIndex::slot(double from) const {
  // whatever its rounding, it grows with `from`: so a piece of an earlier slot begins earlier
  const double place = (from - begins_.front()) * scale_;
  return place > 0.0 ? std::min(static_cast<std::size_t>(place), begins_.size() - 1) : 0;
}

std::size_t PieceIndex::find(double t) const {
  const double from = direction_ * t;
  const std::size_t at = slot(from);
  const auto begin = begins_.begin() + static_cast<std::ptrdiff_t>(first_[at]);
  const auto end = begins_.begin() + static_cast<std::ptrdiff_t>(first_[at + 1]);
  const auto behind = static_cast<std::size_t>(std::upper_bound(begin, end, from) - begins_.begin());
  return behind > 0 ? behind - 1 : 0;
}

}  // namespace trajet
