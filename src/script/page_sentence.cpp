#include "script/page_sentence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "script/sweep_table.hpp"

namespace ricochet {

namespace {

struct Mean {
  std::size_t count = 0;
  double mean = 0, squares = 0;

  void add(double value) {
    ++count;
    const double off = value - mean;
    mean += off / static_cast<double>(count);
    squares += off * (value - mean);
  }
  /// Standard error; of one value undefined.
  double se() const {
    const double n = static_cast<double>(count);
    return count < 2 ? NAN : std::sqrt(squares / (n - 1) / n);
  }
  std::string text() const { return fmt::format("{:.3g} ± {:.2g}", mean, se()); }
};

// "0.99987 and 0.99998": as few digits as tell two numbers apart.
std::string both(double low, double high) {
  for (int digits = 3; digits <= 9; ++digits) {
    const std::string one = fmt::format("{:.{}g}", low, digits), other = fmt::format("{:.{}g}", high, digits);
    if (one != other || low == high) return one + " and " + other;
  }
  return fmt::format("{:.10g} and {:.10g}", low, high);
}

// The parameter that is asked about: the first numeric one with two values or more that counts no samples.
const NumberColumn* asked(const Table& table) {
  for (const NumberColumn& column : table.numbers) {
    const std::string& name = column.field.name;
    if (!sweep_table::is_parameter(column.field) || sweep_table::counts_samples(name)) continue;
    const auto [low, high] = std::minmax_element(column.values.begin(), column.values.end());
    if (low != column.values.end() && *low < *high) return &column;
  }
  return nullptr;
}

std::string counted(std::size_t count) { return fmt::format("{} impact{}", count, count == 1 ? "" : "s"); }

std::string why_none(const Table& table) {
  if (table.rows() == 0) return "No impact has run yet, so there is nothing to report.";
  const TextColumn *status = table.text("status"), *reason = table.text("reason");
  const std::string how = status ? status->values.front() : "", why = reason ? reason->values.front() : "";
  return fmt::format("None of the {} finished, so there is no result to report. The first ended {}{}{}.",
                     counted(table.rows()), how, why.empty() ? "" : ": ", why);
}

std::map<double, Mean> means_at(const Table& table, const NumberColumn& at, const NumberColumn& e) {
  std::map<double, Mean> means;
  for (const sweep_table::Unit& unit : sweep_table::units(table, e)) means[at.values[unit.row]].add(unit.value);
  std::erase_if(means, [](const auto& one) { return one.second.count < 2; });
  return means;
}

std::string shown_name(const NumberColumn& column) {
  std::string name = column.field.name;
  if (name.starts_with("over_")) name = name.substr(5);
  return name == "psi1" ? "Ψ₁" : name;
}

// What the means at several values of a parameter say of it.
std::string dependence(const Table& table, const NumberColumn& e) {
  const NumberColumn* at = asked(table);
  if (!at) return "";
  const std::map<double, Mean> means = means_at(table, *at, e);
  if (means.size() < 2) return "";
  const auto lower = [](const auto& a, const auto& b) { return a.second.mean < b.second.mean; };
  const auto [low, high] = std::minmax_element(means.begin(), means.end(), lower);
  const std::string name = shown_name(*at);
  if (high->second.mean - low->second.mean < 2 * std::hypot(low->second.se(), high->second.se()))
    return fmt::format(
        " Whether e changes with {} these impacts cannot tell: its highest and lowest mean, {} and {}, are within 2 "
        "standard errors of each other.",
        name, high->second.text(), low->second.text());
  return fmt::format(" The mean is highest at {} = {:.4g} ({}) and lowest at {} = {:.4g} ({}).", name, high->first,
                     high->second.text(), name, low->first, low->second.text());
}

std::string of_many(const Table& table, const NumberColumn& e, const Mean& mean, std::size_t above) {
  std::string text = dependence(table, e);
  if (text.empty() && std::abs(mean.mean - 1) < 2 * mean.se())
    text = " Whether the mean is below or above 1 these impacts cannot tell: it is within 2 standard errors of it.";
  if (above > 0)
    text += fmt::format(" In {} of them the projectile left faster along the normal than it came (e > 1).", above);
  return text;
}

std::string sentence_of(const Table& table) {
  std::size_t done = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) done += sweep_table::has_finished(table, row);
  if (done == 0) return why_none(table);
  Mean mean;
  double low = HUGE_VAL, high = -HUGE_VAL;
  std::size_t above = 0;
  const NumberColumn* e = table.number("e");
  for (std::size_t row = 0; e && row < table.rows(); ++row) {
    const double value = e->values[row];
    if (!sweep_table::has_finished(table, row) || std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
    above += value > 1;
  }
  if (e)
    for (const sweep_table::Unit& unit : sweep_table::units(table, *e)) mean.add(unit.value);
  const std::string head = fmt::format("{} of {} finished", done, counted(table.rows()));
  if (mean.count == 0) return head + "; none has a coefficient of restitution e.";
  if (mean.count == 1)
    return fmt::format(
        "{}: the coefficient of restitution is e = {:.3g}. One impact has no error bar; another lattice or mesh "
        "may give another value.",
        head, mean.mean);
  // Means over other parameters than lattices mean little, and their spread is no error.
  if (const NumberColumn* at = asked(table))
    return fmt::format(
        "{}. The coefficient of restitution e lies between {}.{}", head, both(low, high),
        mean.count < many_impacts
            ? fmt::format(" So few impacts show how large e is, and hardly how it changes with {}.", shown_name(*at))
            : of_many(table, *e, mean, above));
  if (mean.count < many_impacts)
    return fmt::format(
        "{}. The coefficient of restitution e lies between {}, its mean is {} (standard "
        "error). So few impacts show how large e is, and hardly what it depends on.",
        head, both(low, high), mean.text());
  return fmt::format("{}. The mean coefficient of restitution is e = {} (standard error).{}", head, mean.text(),
                     of_many(table, *e, mean, above));
}

}  // namespace

std::string report_sentence(const Table& table) {
  const std::string text = sentence_of(table);
  const bool has_error = text.find("±") != std::string::npos;
  return has_error ? text + " What a finer lattice or mesh would change is not in these errors." : text;
}

}  // namespace ricochet
