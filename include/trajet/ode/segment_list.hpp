#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <iterator>
#include <memory>
#include <vector>

#include "trajet/ode/segment.hpp"

namespace trajet {

/// Segments in a row, of fixed or of run-time dimension, each in as little memory as its degree needs; memory is asked
/// for once for many of them. Elements are handed out by value.
template <int Dim>
class SegmentList {
 public:
  SegmentList() = default;
  SegmentList(SegmentList&&) noexcept = default;
  SegmentList& operator=(SegmentList&&) noexcept = default;
  SegmentList(const SegmentList& other) { *this = other; }
  SegmentList& operator=(const SegmentList& other) {
    if (this == &other) return *this;
    *this = SegmentList();
    for (const Segment<Dim>& segment : other) push_back(segment);
    return *this;
  }
  ~SegmentList() = default;

  void push_back(const Segment<Dim>& segment) {
    const std::ptrdiff_t dimension = segment.dimension(), count = segment.coefficients().size();
    double* const place = room_for(dimension + count);
    std::copy_n(segment.error_bound().data(), dimension, place);
    std::copy_n(segment.coefficients().data(), count, place + dimension);
    entries_.push_back({segment.t0(), segment.t1(), place, segment.dimension(), segment.degree()});
  }

  std::size_t size() const { return entries_.size(); }
  bool empty() const { return entries_.empty(); }
  Segment<Dim> operator[](std::size_t i) const {
    const Entry& entry = entries_[i];
    Segment<Dim> segment;
    segment.resize(entry.dimension, entry.degree);
    segment.set_interval(entry.t0, entry.t1);
    std::copy_n(entry.data, entry.dimension, segment.error_bound().data());
    std::copy_n(entry.data + entry.dimension, segment.coefficients().size(), segment.coefficients().data());
    return segment;
  }
  Segment<Dim> front() const { return (*this)[0]; }
  Segment<Dim> back() const { return (*this)[size() - 1]; }
  /// The end of the last one, s.
  double end_time() const { return entries_.back().t1; }
  /// The index of the first one that ends at `t` or behind it, in the direction of the list.
  std::size_t find(double t, double direction) const {
    const auto ends_before = [direction](const Entry& entry, double time) {
      return (time - entry.t1) * direction > 0.0;
    };
    const auto found = std::lower_bound(entries_.begin(), entries_.end(), t, ends_before);
    return static_cast<std::size_t>(found - entries_.begin());
  }

  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Segment<Dim>;
    using difference_type = std::ptrdiff_t;
    using pointer = void;
    using reference = Segment<Dim>;

    Iterator() = default;
    Iterator(const SegmentList& list, std::size_t index) : list_(&list), index_(index) {}
    Segment<Dim> operator*() const { return (*list_)[index_]; }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    Iterator operator++(int) { return {*list_, index_++}; }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.index_ == b.index_; }

   private:
    const SegmentList* list_ = nullptr;
    std::size_t index_ = 0;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

 private:
  struct Entry {
    double t0 = 0.0, t1 = 0.0;
    const double* data = nullptr;  // error bounds, then coefficients
    int dimension = 0, degree = 0;
  };
  static constexpr std::ptrdiff_t kFirstRoom = 512, kMostRoom = 4096;  // numbers: 4 and 32 kB

  double* room_for(std::ptrdiff_t count) {
    if (count > room_) {
      room_ = std::max(count, std::min(kMostRoom, kFirstRoom << std::min<std::size_t>(blocks_.size(), 3)));
      blocks_.push_back(std::unique_ptr<double[]>(new double[static_cast<std::size_t>(room_)]));
      next_ = blocks_.back().get();
    }
    double* const place = next_;
    next_ += count;
    room_ -= count;
    return place;
  }

  std::vector<Entry> entries_;
  std::vector<std::unique_ptr<double[]>> blocks_;
  double* next_ = nullptr;
  std::ptrdiff_t room_ = 0;  // behind next_
};

}  // namespace trajet
