#include "trajet/io/scene_file.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "scene_method.hpp"
#include "scene_solids.hpp"
#include "scene_tables.hpp"
#include "table_runs.hpp"
#include "toml_document.hpp"
#include "value_reader.hpp"

#include "trajet/portable.hpp"

namespace trajet {

namespace {

using detail::TableReader;
using detail::TomlDocument;
using detail::TomlEntry;

/// Reads one scene: the document and what all of its tables share.
class SceneReader {
 public:
  SceneReader(std::string text, const std::string& file)
      : text_(without_byte_order_mark(std::move(text))),
        obstacles_(obstacle_runs(text_)),
        document_(obstacles_.runs.empty() ? text_ : obstacles_.rest, file),
        formulas_(file) {
    // with obstacles said otherwise too, it is for the reader of TOML to say whether they go together
    if (!obstacles_.runs.empty() && document_.root().contains("obstacle")) {
      obstacles_ = {};
      document_ = TomlDocument(text_, file);
    }
    collect_names();
  }

  Scene read() {
    const detail::Keys keys = detail::scene_keys();
    const TableReader root = reader(document_);
    root.check_keys(detail::names(keys));

    Scene scene;
    scene.file = document_.file().str();
    if (root.has("title")) scene.title = root.text("title");
    scene.up = std::array{UpAxis::y, UpAxis::z}[root.choice("up", detail::words(keys, "up"), 1)];
    if (root.has("parameters")) scene.parameters = named_formulas(root.subtable("parameters").titled("[parameters]"));
    if (!root.has("time")) throw InputError(root.where(), "the scene lacks the table [time] with the key 'end'");
    scene.time = read_time(root.subtable("time").titled("[time]"));
    scene.method.where = root.where();
    if (root.has("method")) scene.method = detail::read_method(root.subtable("method").titled("[method]"));
    for (const TableReader& table : array_of_tables(document_, "body"))
      scene.bodies.push_back(detail::read_body(table));
    read_obstacles(scene);
    for (const TableReader& table : array_of_tables(document_, "pair")) scene.pairs.push_back(detail::read_pair(table));
    for (const TableReader& table : array_of_tables(document_, "state")) scene.states.push_back(read_state(table));
    for (const TableReader& table : array_of_tables(document_, "event")) scene.events.push_back(read_event(table));
    if (root.has("exact")) read_exact(root.subtable("exact").titled("[exact]"), "", scene);
    scene.tables = formulas_.tables();
    return scene;
  }

 private:
  static std::string without_byte_order_mark(std::string text) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
    return text;
  }

  /// The obstacles of a scene that has many of them; else nothing.
  static detail::TableRuns obstacle_runs(std::string_view text) {
    constexpr std::size_t kTablesARun = 256;
    detail::TableRuns cut = detail::cut_table_runs(text, "obstacle", kTablesARun);
    return cut.table_count > kTablesARun ? cut : detail::TableRuns();
  }

  /// All of a document.
  TableReader reader(const TomlDocument& document) {
    return {document, document.root(), "the scene", {document.file(), 1, 1}, formulas_};
  }

  /// Those of the document, then those that were cut out of it.
  void read_obstacles(Scene& scene) {
    scene.obstacles.reserve(obstacles_.table_count);
    const auto read = [&](const TomlDocument& document) {
      for (const TableReader& table : array_of_tables(document, "obstacle"))
        scene.obstacles.push_back(detail::read_obstacle(table));
    };
    read(document_);
    for (const detail::TextStretch& run : obstacles_.runs)
      read({std::string_view(text_).substr(run.begin, run.size), document_.file(), run.first_line});
  }

  /// They must be known before the first expression is read.
  void collect_names() {
    for (const std::string_view group : {"body", "state"}) {
      const toml::array* tables = document_.root()[group].as_array();
      for (std::size_t i = 0; tables != nullptr && i < tables->size(); ++i) {
        const toml::table* table = tables->get(i)->as_table();
        if (table != nullptr) formulas_.add_name((*table)["name"].value_or(std::string_view()));
      }
    }
    if (const toml::table* parameters = document_.root()["parameters"].as_table())
      for (const auto& [key, node] : *parameters) formulas_.add_name(key.str());
  }

  std::vector<TableReader> array_of_tables(const TomlDocument& document, std::string_view key) {
    const TableReader root = reader(document);
    std::vector<TableReader> readers;
    if (!root.has(key)) return readers;
    const std::string title = "[[" + std::string(key) + "]]";
    const toml::array* tables = root.table().get(key)->as_array();
    if (tables == nullptr) root.fail(key, "an array of tables expected, write " + title);
    for (const toml::node& node : *tables) {
      const SourceLocation where = document.location(node);
      if (!node.is_table()) throw InputError(where, "a table expected, write " + title);
      readers.push_back({document, *node.as_table(), title, where, formulas_});
    }
    return readers;
  }

  /// The keys of a table with a formula each. A table within gives names with a point: `ball.r = …`.
  std::vector<NamedExpression> named_formulas(const TableReader& table, const std::string& prefix = "") const {
    std::vector<NamedExpression> formulas;
    for (const auto& [key, node] : detail::entries_in_file_order(table.table())) {
      const std::string name = prefix + std::string(key->str());
      if (node->is_table() && prefix.empty()) {
        for (NamedExpression& part : named_formulas(table.subtable(key->str()), name + "."))
          formulas.push_back(std::move(part));
      } else {
        formulas.push_back({name, table.formula(key->str()), document_.location(*key)});
      }
    }
    return formulas;
  }

  /// Closed forms by name: formulas, and orientations in the forms in which a body's start gives them.
  void read_exact(const TableReader& table, const std::string& prefix, Scene& scene) const {
    for (const auto& [key, node] : detail::entries_in_file_order(table.table())) {
      const std::string name = prefix + std::string(key->str());
      if (node->is_table() && name.ends_with(".orientation")) {
        const TableReader orientation = table.subtable(key->str()).titled("[exact] " + name);
        scene.exact_orientations.push_back({name, detail::read_orientation(orientation), document_.location(*key)});
      } else if (node->is_table() && prefix.empty()) {
        read_exact(table.subtable(key->str()), name + ".", scene);
      } else {
        scene.exact.push_back({name, table.formula(key->str()), document_.location(*key)});
      }
    }
    if (!prefix.empty()) gather_quaternion(prefix, scene);
  }

  /// Four closed forms `ball.qw` … `ball.qz` are one of the orientation.
  static void gather_quaternion(const std::string& prefix, Scene& scene) {
    OrientationDefinition orientation;
    for (const char* part : {"qw", "qx", "qy", "qz"}) {
      const auto found = ranges::find(scene.exact, prefix + part, &NamedExpression::name);
      if (found == scene.exact.end()) continue;
      if (orientation.quaternion.empty()) orientation.where = found->where;
      orientation.quaternion.push_back(std::move(found->value));
      scene.exact.erase(found);
    }
    if (orientation.quaternion.empty()) return;
    const std::string name = prefix + "orientation";
    if (orientation.quaternion.size() != 4)
      throw InputError(orientation.where, "a quaternion has four parts: " + prefix + "qw, qx, qy, qz expected, got " +
                                              std::to_string(orientation.quaternion.size()));
    scene.exact_orientations.push_back({name, orientation, orientation.where});
  }

  static TimeOptions read_time(const TableReader& table) {
    table.check_keys(detail::names(detail::time_keys()));
    TimeOptions time;
    if (table.has("start")) time.start = table.scalar("start", kTime);
    time.end = table.scalar("end", kTime);
    time.sample = table.optional_scalar("sample", kTime);
    return time;
  }

  static StateDefinition read_state(const TableReader& table) {
    table.check_keys(detail::names(detail::state_keys()));
    return {table.text("name"), table.scalar("value", std::nullopt), table.scalar("rate", std::nullopt),
            table.where("name")};
  }

  EventDefinition read_event(const TableReader& table) const {
    const detail::Keys keys = detail::event_keys();
    table.check_keys(detail::names(keys));
    EventDefinition event{
        table.text("name"), table.scalar("when", std::nullopt), CrossingDirection::any, EventAction::record, {},
        table.where("name")};
    event.direction = detail::read_direction(table);

    // Both `set = {…}` and `action = {set = {…}}` are read.
    const bool nested = table.has("action") && table.table().get("action")->is_table();
    const TableReader holder = nested ? table.subtable("action") : table;
    if (nested) holder.check_keys(std::array<std::string_view, 1>{"set"});
    const std::size_t default_action = table.has("set") ? 2 : 0;
    event.action = std::array{
        EventAction::record, EventAction::stop,
        EventAction::set}[nested ? 2 : table.choice("action", detail::words(keys, "action"), default_action)];
    if (nested && table.has("set")) table.fail("set", "'set' stands beside another one in 'action'");
    if (event.action == EventAction::set)
      event.set = named_formulas(holder.subtable("set"));
    else if (table.has("set"))
      table.fail("set", "'set' does not go with action = \"" + table.text("action") + "\"");
    return event;
  }

  std::string text_;
  detail::TableRuns obstacles_;  // empty where the document has them
  TomlDocument document_;
  detail::FormulaReader formulas_;
};

std::string read_text(const std::string& path) {
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rb"));
  if (file == nullptr) throw FileError("cannot open '" + path + "'");
  std::string text;
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  if (!unknown) text.reserve(size);  // a pipe has none
  char block[16384];
  for (std::size_t count; (count = std::fread(block, 1, sizeof block, file.get())) > 0;) text.append(block, count);
  if (std::ferror(file.get()) != 0) throw FileError("cannot read '" + path + "'");
  return text;
}

}  // namespace

Scene read_scene(const std::string& path) { return parse_scene(read_text(path), path); }

Scene parse_scene(std::string text, const std::string& file) { return SceneReader(std::move(text), file).read(); }

}  // namespace trajet
