#include "trajet/io/sweep_hdf5.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "trajet/error.hpp"

#ifdef TRAJET_HDF5_LIBRARY
#include <hdf5.h>

#include "shared_library.hpp"
#endif

namespace trajet {

bool is_hdf5_name(const std::string& path) { return path.ends_with(".h5") || path.ends_with(".hdf5"); }

#ifdef TRAJET_HDF5_LIBRARY
namespace {

/// What is called of HDF5's interface in C, and its types, which are variables of the library.
struct Hdf5 {
  detail::SharedLibrary library{TRAJET_HDF5_LIBRARY, "writes HDF5 files"};
#define TRAJET_HDF5_FUNCTION(name) decltype(H5##name)* name = library.function<decltype(H5##name)>("H5" #name)
  TRAJET_HDF5_FUNCTION(open);
  TRAJET_HDF5_FUNCTION(Eset_auto2);
  TRAJET_HDF5_FUNCTION(Fcreate);
  TRAJET_HDF5_FUNCTION(Fclose);
  TRAJET_HDF5_FUNCTION(Gcreate2);
  TRAJET_HDF5_FUNCTION(Gclose);
  TRAJET_HDF5_FUNCTION(Screate);
  TRAJET_HDF5_FUNCTION(Screate_simple);
  TRAJET_HDF5_FUNCTION(Sselect_hyperslab);
  TRAJET_HDF5_FUNCTION(Sclose);
  TRAJET_HDF5_FUNCTION(Pcreate);
  TRAJET_HDF5_FUNCTION(Pset_chunk);
  TRAJET_HDF5_FUNCTION(Pset_shuffle);
  TRAJET_HDF5_FUNCTION(Pset_deflate);
  TRAJET_HDF5_FUNCTION(Pset_obj_track_times);
  TRAJET_HDF5_FUNCTION(Pclose);
  TRAJET_HDF5_FUNCTION(Dcreate2);
  TRAJET_HDF5_FUNCTION(Dwrite);
  TRAJET_HDF5_FUNCTION(Dclose);
  TRAJET_HDF5_FUNCTION(Acreate2);
  TRAJET_HDF5_FUNCTION(Awrite);
  TRAJET_HDF5_FUNCTION(Aclose);
  TRAJET_HDF5_FUNCTION(Tcopy);
  TRAJET_HDF5_FUNCTION(Tset_size);
  TRAJET_HDF5_FUNCTION(Tset_cset);
  TRAJET_HDF5_FUNCTION(Tclose);
#undef TRAJET_HDF5_FUNCTION

  hid_t variable(const char* name) const { return *library.function<hid_t>(name); }

  Hdf5() {
    open();
    Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // faults are told by us
  }
};

constexpr unsigned kTruncate = 2;  // H5F_ACC_TRUNC, which as a macro calls the library

const Hdf5& hdf5() {
  static const Hdf5 functions;
  return functions;
}

/// An open thing of the library, which closes with the object.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw FileError("HDF5 refuses");
  }
  ~Handle() { close_(id_); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): as the library's functions take it

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void require(herr_t result) {
  if (result < 0) throw FileError("HDF5 refuses");
}

/// A text of at most that many bytes, UTF-8.
class TextType : public Handle {
 public:
  explicit TextType(std::size_t size) : Handle(hdf5().Tcopy(hdf5().variable("H5T_C_S1_g")), hdf5().Tclose) {
    require(hdf5().Tset_size(*this, std::max<std::size_t>(size, 1)));
    require(hdf5().Tset_cset(*this, H5T_CSET_UTF8));
  }
};

void write_attribute(hid_t owner, const std::string& name, const std::string& text) {
  const TextType type(text.size());
  const Handle space(hdf5().Screate(H5S_SCALAR), hdf5().Sclose);
  const Handle attribute(hdf5().Acreate2(owner, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), hdf5().Aclose);
  require(hdf5().Awrite(attribute, type, text.empty() ? "" : text.c_str()));
}

/// A column that grows chunk by chunk.
class Column {
 public:
  static constexpr hsize_t kChunk = 16384;

  Column(hid_t group, const std::string& name, hid_t type, std::size_t size, hsize_t count)
      : type_(type),
        size_(size),
        space_(hdf5().Screate_simple(1, &count, nullptr), hdf5().Sclose),
        data_(create(group, name, count), hdf5().Dclose) {}

  hid_t id() const { return data_; }

  void add(const char* bytes) {
    buffer_.append(bytes, size_);
    if (buffer_.size() == kChunk * size_) flush();
  }
  void flush() {
    const hsize_t count = buffer_.size() / size_;
    if (count == 0) return;
    require(hdf5().Sselect_hyperslab(space_, H5S_SELECT_SET, &written_, nullptr, &count, nullptr));
    const Handle memory(hdf5().Screate_simple(1, &count, nullptr), hdf5().Sclose);
    require(hdf5().Dwrite(data_, type_, memory, space_, H5P_DEFAULT, buffer_.data()));
    written_ += count;
    buffer_.clear();
  }

 private:
  hid_t create(hid_t group, std::string name, hsize_t count) const {
    std::string link;  // where a slash would be a path
    for (const char c : name) link += c == '/' ? "\u2215" : std::string(1, c);
    const Handle properties(hdf5().Pcreate(hdf5().variable("H5P_CLS_DATASET_CREATE_ID_g")), hdf5().Pclose);
    const hsize_t chunk = std::clamp<hsize_t>(count, 1, kChunk);
    require(hdf5().Pset_chunk(properties, 1, &chunk));
    require(hdf5().Pset_shuffle(properties));
    require(hdf5().Pset_deflate(properties, 4));
    require(hdf5().Pset_obj_track_times(properties, false));  // the same rows make the same bytes
    return hdf5().Dcreate2(group, link.c_str(), type_, space_, H5P_DEFAULT, properties, H5P_DEFAULT);
  }

  hid_t type_;
  std::size_t size_;
  Handle space_;
  Handle data_;
  hsize_t written_ = 0;
  std::string buffer_;
};

/// The columns of one file, and the rows that go into them.
class Table {
 public:
  Table(hid_t file, const SweepResults& results) : results_(results), words_(results.words()) {
    std::size_t longest = 1;
    for (const std::string& word : words_) longest = std::max(longest, word.size());
    word_size_ = longest;
    word_type_ = std::make_unique<TextType>(longest);
    const SweepHeader& header = results.header();
    const auto count = static_cast<hsize_t>(results.row_count());
    const auto group = [&](const char* name) {
      return Handle(hdf5().Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), hdf5().Gclose);
    };
    const Handle quantities = group("quantities"), columns = group("columns");
    const hid_t number = hdf5().variable("H5T_NATIVE_DOUBLE_g");
    for (const std::string& name : header.quantities)
      columns_.push_back(std::make_unique<Column>(quantities, name, number, sizeof(double), count));
    for (std::size_t i = 0; i < header.columns.size(); ++i) {
      const bool is_word = results.is_word(i);
      columns_.push_back(std::make_unique<Column>(columns, header.columns[i], is_word ? hid_t(*word_type_) : number,
                                                  is_word ? word_size_ : sizeof(double), count));
      write_attribute(columns_.back()->id(), "expression", header.columns[i]);
    }
    index_ =
        std::make_unique<Column>(file, "index", hdf5().variable("H5T_NATIVE_UINT64_g"), sizeof(std::uint64_t), count);
  }

  void write() {
    results_.each_row([&](std::span<const double> row) {
      for (std::size_t i = 0; i < columns_.size(); ++i) add(i, row[i]);
      const auto index = static_cast<std::uint64_t>(row.back());
      index_->add(reinterpret_cast<const char*>(&index));
    });
    for (const auto& column : columns_) column->flush();
    index_->flush();
  }

 private:
  void add(std::size_t column, double number) {
    const std::size_t quantities = results_.header().quantities.size();
    if (column < quantities || !results_.is_word(column - quantities)) {
      columns_[column]->add(reinterpret_cast<const char*>(&number));
      return;
    }
    std::string word = std::isnan(number) ? std::string() : words_[static_cast<std::size_t>(number)];
    word.resize(word_size_);
    columns_[column]->add(word.data());
  }

  const SweepResults& results_;
  std::vector<std::string> words_;
  std::size_t word_size_ = 0;
  std::unique_ptr<TextType> word_type_;
  std::vector<std::unique_ptr<Column>> columns_;
  std::unique_ptr<Column> index_;
};

}  // namespace

void require_hdf5() { hdf5(); }

void write_sweep_hdf5(const std::string& path, const SweepResults& results, const SweepOrigin& origin) {
  const std::string beside = path + ".part";
  try {
    const Handle file(hdf5().Fcreate(beside.c_str(), kTruncate, H5P_DEFAULT, H5P_DEFAULT), hdf5().Fclose);
    for (const auto& [name, text] : origin) write_attribute(file, name, text);
    Table(file, results).write();
  } catch (const FileError&) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw FileError("cannot write " + path);
  }
  std::filesystem::rename(beside, path);
}

#else

void require_hdf5() { throw FileError("this build cannot write HDF5: write CSV"); }

void write_sweep_hdf5(const std::string&, const SweepResults&, const SweepOrigin&) { require_hdf5(); }

#endif

}  // namespace trajet
