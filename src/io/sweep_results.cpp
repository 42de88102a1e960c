#include "trajet/io/sweep_results.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "record_json.hpp"
#include "trajet/portable.hpp"
#include "trajet/text/shortest_text.hpp"
#include "trajet/version.hpp"

namespace trajet {
namespace {

using detail::Json;

/// The number itself, which outlives the view.
std::string_view bytes_of(const double& number) { return {reinterpret_cast<const char*>(&number), sizeof number}; }

bool read_number(Spool::Reader& reader, double& number) {
  return reader.read({reinterpret_cast<char*>(&number), sizeof number});
}

}  // namespace

SweepResults::SweepResults(SweepHeader header, const std::string& beside, std::map<std::string, Vector3> aims)
    : header_(std::move(header)),
      aims_(std::move(aims)),
      statistics_(header_.columns.size()),
      has_words_(header_.columns.size()),
      spool_(beside, header_.quantities.size() + header_.columns.size() + 1) {}

std::vector<std::string> SweepResults::words() const {
  std::vector<std::string> words(words_.size());
  for (const auto& [word, number] : words_) words[static_cast<std::size_t>(number)] = word;
  return words;
}

double SweepResults::word_number(const std::string& word) {
  return words_.try_emplace(word, static_cast<double>(words_.size())).first->second;
}

void SweepResults::add(const SweepRow& row) {
  for (std::size_t i = 0; i < row.values.size(); ++i) spool_.append(i, bytes_of(row.values[i]));
  for (std::size_t i = 0; i < header_.columns.size(); ++i) {
    double number = std::nan("");
    if (const auto* value = std::get_if<double>(&row.cells[i])) {
      number = *value;
      statistics_[i].add(number);
    } else if (const auto* word = std::get_if<std::string>(&row.cells[i])) {
      number = word_number(*word);
      has_words_[i] = true;
    }
    spool_.append(row.values.size() + i, bytes_of(number));
  }
  spool_.append(row.values.size() + header_.columns.size(), bytes_of(static_cast<double>(row.index)));
  ++row_count_;
}

NumberSource SweepResults::numbers(std::size_t stream) const {
  return [this, stream](const std::function<void(double)>& use) {
    Spool::Reader reader(spool_, stream);
    for (double number = 0.0; read_number(reader, number);)
      if (!std::isnan(number)) use(number);
  };
}

void SweepResults::each_row(const std::function<void(std::span<const double>)>& use) const {
  const std::size_t streams = header_.quantities.size() + header_.columns.size() + 1;
  std::vector<Spool::Reader> readers;
  for (std::size_t i = 0; i < streams; ++i) readers.emplace_back(spool_, i);
  std::vector<double> row(streams);
  for (std::uint64_t n = 0; n < row_count_; ++n) {
    for (std::size_t i = 0; i < streams; ++i) read_number(readers[i], row[i]);
    use(row);
  }
}

/// Where a row has what was hit first, and where.
std::optional<std::array<std::size_t, 4>> SweepResults::impact_columns() const {
  std::array<std::size_t, 4> result{};
  constexpr std::array<std::string_view, 4> kNames{"hit", "impact(1).x", "impact(1).y", "impact(1).z"};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    const auto place = ranges::find(header_.columns, kNames[i]);
    if (place == header_.columns.end()) return std::nullopt;
    result[i] = header_.quantities.size() + static_cast<std::size_t>(place - header_.columns.begin());
  }
  return result;
}

SweepSummary SweepResults::summary(const SweepTally& tally) const {
  SweepSummary result{.tally = tally};
  for (std::size_t i = 0; i < header_.columns.size(); ++i) {
    const RunningStatistics& statistics = statistics_[i];
    if (statistics.count() == 0) continue;
    result.columns.push_back(
        {header_.columns[i], statistics,
         quantiles(numbers(header_.quantities.size() + i), statistics.count(), SweepSummary::kShares)});
  }
  const std::optional<std::array<std::size_t, 4>> columns = impact_columns();
  for (const auto& [name, count] : tally.hits) {
    SweepSummary::Hit hit{name, count,
                          static_cast<double>(count) / static_cast<double>(std::max<std::uint64_t>(tally.count, 1)),
                          exact_share_interval(count, tally.count)};
    const auto word = words_.find(name);
    if (columns && word != words_.end() && count >= 2) {
      const PointSource points = [&](const std::function<void(const Vector3&)>& use) {
        each_row([&](std::span<const double> row) {
          if (row[(*columns)[0]] == word->second) use({row[(*columns)[1]], row[(*columns)[2]], row[(*columns)[3]]});
        });
      };
      hit.dispersion = dispersion(points);
      if (const auto aim = aims_.find(name); aim != aims_.end())
        hit.about_aim = circles_about(aim->second, hit.dispersion->count, points);
    }
    result.hits.push_back(std::move(hit));
  }
  return result;
}

namespace {

Json circles_json(const std::array<Dispersion::Circle, 3>& circles, const char* prefix) {
  Json result = Json::object();
  for (const Dispersion::Circle& circle : circles) {
    const std::string name = prefix + std::to_string(std::lround(100.0 * circle.share));
    result[name] = circle.radius;
    result[name + "_ci95"] = circle.ci95;
  }
  return result;
}

Json column_json(const SweepSummary::Column& column) {
  Json shares = Json::object();
  for (std::size_t i = 0; i < column.quantiles.size(); ++i)
    shares[shortest_text(SweepSummary::kShares[i])] = column.quantiles[i];
  const RunningStatistics& numbers = column.numbers;
  return {{"count", numbers.count()},
          {"mean", numbers.mean()},
          {"sd", numbers.count() > 1 ? Json(numbers.deviation()) : Json(nullptr)},
          {"min", numbers.min()},
          {"max", numbers.max()},
          {"quantiles", std::move(shares)}};
}

Json hit_json(const SweepSummary::Hit& hit) {
  Json result{{"count", hit.count}, {"share", hit.share}, {"ci95", {hit.ci95.low, hit.ci95.high}}};
  if (!hit.dispersion) return result;
  const Dispersion& spread = *hit.dispersion;
  result["dispersion"] = {
      {"mean", detail::array(spread.mean)},        {"major_axis", detail::array(spread.major)},
      {"minor_axis", detail::array(spread.minor)}, {"major_sd", spread.major_deviation},
      {"minor_sd", spread.minor_deviation},        {"about_mean", circles_json(spread.about_mean, "cep")}};
  if (hit.about_aim) result["dispersion"]["about_aim"] = circles_json(*hit.about_aim, "r");
  return result;
}

}  // namespace

std::string sweep_summary_json(const SweepTitle& title, const SweepSummary& summary) {
  Json columns = Json::object(), hits = Json::object();
  for (const SweepSummary::Column& column : summary.columns) columns[column.name] = column_json(column);
  for (const SweepSummary::Hit& hit : summary.hits) hits[hit.name] = hit_json(hit);
  return detail::json_text({{"trajet", kVersion},
                            {"scene", title.scene},
                            {"title", title.title},
                            {"count", summary.tally.count},
                            {"seed", title.seed},
                            {"design", title.design},
                            {"failed", summary.tally.failed},
                            {"columns", std::move(columns)},
                            {"hits", std::move(hits)}});
}

}  // namespace trajet
