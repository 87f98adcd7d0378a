#include "script/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "script/page_sentence.hpp"
#include "script/page_sources.hpp"
#include "script/page_text.hpp"
#include "script/sweep_table.hpp"
#include "store/packed.hpp"

namespace ricochet {

namespace {

const std::string replay_begins = "<script type=\"application/json\" class=\"replay\" id=\"replay-";
constexpr std::size_t hash_length = 32;

// Bit by bit, so that NaN is the same as NaN.
bool is_constant(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [&](double value) { return std::memcmp(&value, values.data(), sizeof value) == 0; });
}

template <class Number>
std::string binary(const std::vector<double>& values) {
  std::string bytes;
  for (const double value : values) {
    const Number number = static_cast<Number>(value);
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  return "\"" + base64(deflated(bytes)) + "\"";
}

std::string values_json(const std::vector<double>& values) {
  if (values.size() > 1 && is_constant(values)) return "\"same\":" + json_number(values.front());
  if (values.size() > most_whole_rows) return "\"float32\":" + binary<float>(values);
  if (values.size() > most_text_rows) return "\"float64\":" + binary<double>(values);
  return "\"values\":" + json_numbers(values);
}

std::string values_json(const std::vector<std::string>& values) {
  if (values.size() > 1 && std::all_of(values.begin(), values.end(), [&](auto& v) { return v == values.front(); }))
    return "\"same\":" + json_text(values.front());
  std::string list;
  for (const std::string& value : values) list += (list.empty() ? "" : ",") + json_text(value);
  return "\"values\":[" + list + "]";
}

template <class Column>
std::string columns_json(const std::vector<Column>& columns, bool main_only) {
  std::string list;
  for (const Column& column : columns) {
    if (main_only && !is_main(column.field)) continue;
    list += fmt::format("{}{{\"name\":{},\"unit\":{},\"doc\":{},{}}}", list.empty() ? "" : ",",
                        json_text(column.field.name), json_text(column.field.unit), json_text(column.field.doc),
                        values_json(column.values));
  }
  return list;
}

std::string texts_json(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : ",") + json_text(text);
  return "[" + list + "]";
}

std::string provenance_json(const Provenance& provenance) {
  std::string list;
  for (const auto& [name, value] : provenance)
    if (name != "script") list += fmt::format("{}{}:{}", list.empty() ? "" : ",", json_text(name), json_text(value));
  return "{" + list + "}";
}

std::string lines_json(const std::vector<PageLine>& lines) {
  std::string list;
  for (const PageLine& line : lines)
    list += fmt::format("{}{{\"of\":{},\"label\":{},\"marks\":{},\"against\":{},\"x\":{},\"y\":{}}}",
                        list.empty() ? "" : ",", json_text(line.of), json_text(line.label), line.marks,
                        json_text(line.against), json_numbers(line.x), json_numbers(line.y));
  return "[" + list + "]";
}

std::string plots_json(const std::vector<PagePlot>& plots) {
  std::string list;
  for (const PagePlot& plot : plots)
    list += fmt::format("{}{{\"x\":{},\"columns\":{},\"lines\":{}}}", list.empty() ? "" : ",", json_text(plot.x),
                        texts_json(plot.columns), lines_json(plot.lines));
  return "[" + list + "]";
}

std::string data_json(const Page& page, const std::vector<std::string>& told) {
  std::string sections;
  for (std::size_t i = 0; i < page.sections.size(); ++i)
    sections += (i ? "," : "") + section_json(page.sections[i], told[i]);
  return fmt::format(
      "{{\"title\":{},\"notes\":{},\"log\":{},\"questions\":{},\"lines\":{},\"plots\":{},\"manyImpacts\":{},"
      "\"sections\":[{}]}}",
      json_text(page.title), json_text(page.notes), json_text(page.log), texts_json(page.questions),
      lines_json(page.lines), texts_json(page.columns), many_impacts, sections);
}

std::string hash_of(const std::string& replay) {
  const std::size_t at = replay.find("\"hash\":\"");
  return at == std::string::npos ? "" : replay.substr(at + 8, hash_length);
}

// The replays, one a line, as many as the budget takes; what of them was left out is told.
std::string replay_elements(const Page& page, std::vector<std::string>& told, std::size_t room) {
  std::string elements;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < page.sections.size(); ++i) {
    std::size_t left_out = 0;
    for (const std::string& replay : page.sections[i].replays) {
      if (!seen.insert(hash_of(replay)).second) continue;
      if (elements.size() + replay.size() + 200 > room)
        ++left_out;
      else
        elements += replay_element(replay);
    }
    if (left_out > 0)
      told[i] += fmt::format("{}{} replay{} left out: a report is kept below {} MB.", told[i].empty() ? "" : " ",
                             left_out, left_out == 1 ? " was" : "s were", most_page_bytes / 1'000'000);
  }
  return elements;
}

std::string script_of(const Page& page) {
  for (const PageSection& section : page.sections)
    if (const std::string script = script_in(section); !script.empty()) return script;
  return "";
}

std::string elements(const char* tag, const std::vector<PagePart>& parts) {
  std::string list;
  for (const PagePart& part : parts) list += fmt::format("<{0}>\n{1}</{0}>\n", tag, part.text);
  return list;
}

// The sources that a policy lets run: " 'sha256-...' ...".
std::string hashes(const std::vector<PagePart>& parts) {
  std::string list;
  for (const PagePart& part : parts) {
    const std::string digits = part.sha256;
    std::string bytes;
    for (std::size_t i = 0; i < digits.size(); i += 2)
      bytes.push_back(static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16)));
    list += fmt::format(" 'sha256-{}'", base64(bytes));
  }
  return list;
}

// Not every frame has every mark.
void put_in(std::string& html, const std::string& mark, const std::string& text) {
  if (const std::size_t at = html.find(mark); at != std::string::npos) html.replace(at, mark.size(), text);
}

}  // namespace

std::string shown_log(const std::string& log) {
  constexpr std::size_t most = 20000;
  return log.size() <= most ? log : log.substr(0, most) + "\n(the rest is in run.log)";
}

bool is_main(const Field& field) {
  static const std::set<std::string> names{"e",      "mu",     "beta",       "energy_closure", "certified",
                                           "status", "folded", "over_yield", "penetration"};
  return sweep_table::is_parameter(field) || names.count(field.name) > 0;
}

std::string section_json(const PageSection& section, const std::string& told) {
  const bool main_only = section.table.rows() > most_whole_rows;
  const std::string numbers = columns_json(section.table.numbers, main_only),
                    texts = columns_json(section.table.texts, main_only);
  return fmt::format(
      "{{\"name\":{},\"rows\":{},\"sentence\":{},\"told\":{},\"mainOnly\":{},\"plots\":{},\"columns\":[{}{}{}],"
      "\"provenance\":{}}}",
      json_text(section.name), section.table.rows(), json_text(report_sentence(section.table)), json_text(told),
      main_only, plots_json(section.plots), numbers, numbers.empty() || texts.empty() ? "" : ",", texts,
      provenance_json(section.provenance));
}

std::string replay_element(const std::string& replay) {
  return fmt::format("{}{}\">{}</script>\n", replay_begins, hash_of(replay), replay);
}

std::string script_in(const PageSection& section) {
  const auto script = section.provenance.find("script");
  return script == section.provenance.end() ? "" : script->second;
}

std::string assembled(const PageParts& parts) {
  std::string html = parts.frame;
  put_in(html, "<!--HEAD-->", page_source::head_html);
  put_in(html, "<!--PLAYER-->", page_source::player_html);
  put_in(html, "<!--CODE-->", elements("script", parts.code));
  put_in(html, "<!--DATA-->",
         "<script type=\"application/json\" id=\"data\">" + parts.data + "</script>\n" + parts.replays);
  put_in(html, "<!--SCRIPT-->", html_text(parts.script));
  put_in(html, "<!--LEAD-->", parts.lead);
  put_in(html, "<!--HEADING-->", html_text(parts.title));
  put_in(html, "<!--STYLE-->", elements("style", parts.styles));
  put_in(html, "<!--TITLE-->", fmt::format("{} – Ricochet {}", html_text(parts.title), parts.kind));
  put_in(html, "<!--POLICY-->",
         fmt::format("default-src 'none'; script-src{}; style-src{}; img-src data: blob:", hashes(parts.code),
                     hashes(parts.styles)));
  return html;
}

std::string html_of(const Page& page) {
  std::string lead;
  for (const PageSection& section : page.sections) {
    if (page.sections.size() > 1) lead += "<b>" + html_text(section.name) + "</b>: ";
    lead += html_text(report_sentence(section.table)) + "<br>\n";
  }
  using namespace page_source;
  std::vector<std::string> told;
  for (const PageSection& section : page.sections) told.push_back(section.told);
  PageParts parts{
      .frame = page_html,
      .kind = "report",
      .styles = {uplot_uPlot_min_css, page_css},
      .code = {uplot_uPlot_iife_js, decode_js, words_js, replay_js, player_js, plots_js, tables_js, page_js},
      .title = page.title,
      .lead = lead,
      .data = data_json(page, told),
      .script = script_of(page)};
  const std::vector<std::string> told_by_sections = told;
  const std::size_t others = assembled(parts).size() + 1000 * page.sections.size();
  parts.replays = replay_elements(page, told, most_page_bytes > others ? most_page_bytes - others : 0);
  if (told != told_by_sections) parts.data = data_json(page, told);
  return assembled(parts);
}

std::map<std::string, std::string> replays_in(const std::string& html) {
  std::map<std::string, std::string> replays;
  for (std::size_t at = html.find(replay_begins); at != std::string::npos; at = html.find(replay_begins, at)) {
    at += replay_begins.size();
    const std::size_t begins = html.find('>', at) + 1, ends = html.find("</script>", at);
    if (ends == std::string::npos || begins > ends) break;
    replays[html.substr(at, hash_length)] = html.substr(begins, ends - begins);
  }
  return replays;
}

}  // namespace ricochet
