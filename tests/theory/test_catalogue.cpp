// What holds of every theory in the catalogue: dimensions, ranges, values.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <sstream>

#include "theory/catalogue.hpp"
#include "theory/claims.hpp"
#include "theory/errata.hpp"

using namespace ricochet;
using namespace ricochet::theory;

namespace {

using Given = std::map<std::string, Value>;

// Every argument of every theory at a generic point within all ranges, all fields set, every one with a value of its
// own.
Given generic(const Theory& theory) {
  static const std::map<std::string, double> values{
      {"R", 0.7},       {"R2", 1.9},     {"E", 3.1},        {"E2", 5.3},        {"E_star", 2.9},    {"nu", 0.21},
      {"nu2", 0.33},    {"m", 1.7},      {"m2", 2.3},       {"v", 0.0113},      {"h", 0.031},       {"eta", 0.13},
      {"shear", 0.011}, {"bulk", 0.017}, {"shear2", 0.023}, {"bulk2", 0.029},   {"rate", 0.19},     {"tau0", 0.037},
      {"rho", 1.3},     {"rho2", 1.1},   {"F", 0.043},      {"n", 2},           {"count", 3},       {"L", 0.9},
      {"L2", 1.4},      {"c", 5.1},      {"theta", 0.6},    {"Y", 0.005},       {"pressure", 2.8},  {"psi1", 1.1},
      {"mu", 0.31},     {"e", 0.87},     {"e_alpha", 0.83}, {"offset", 0.47},   {"beta0", 0.41},    {"beta_x", 3.2},
      {"steps", 2000},  {"speed", 0.12}, {"alpha", 700},    {"omega_most", 11}, {"thickness", 0.4}, {"springs", 200}};
  static const std::map<std::string, Numbers> lists{{"psi1", {0.3, 0.9, 1.8, 3.1, 4.4}},
                                                    {"psi2", {-0.1, -0.3, 0.2, 1.4, 2.9}},
                                                    {"mu", {0.1, 0.2, 0.3, 0.28, 0.25}},
                                                    {"e", {0.8, 0.82, 0.85, 0.81, 0.9}},
                                                    {"e_alpha", {0.8, 0.82, 0.85, 0.81, 0.8}},
                                                    {"offset", {0.5, 0.52, 0.45, 0.41, 0.4}},
                                                    {"at", {0.5, 2.2}}};
  Given given;
  for (const Field& field : theory.arguments) {
    if (field.type == "string")
      given[field.name] = field.choices.back();
    else if (field.type == "numbers")
      given[field.name] = lists.at(field.name);
    else
      given[field.name] = values.at(field.name);
  }
  return given;
}

// The factor of a unit "M^a L^b T^c" when mass, length and time are measured in other units.
double factor(const std::string& unit, double mass, double length, double time) {
  double result = 1;
  std::istringstream words(unit);
  for (std::string word; words >> word;) {
    double power = 1;
    if (word.size() > 1) {
      REQUIRE(word[1] == '^');
      std::istringstream number(word.substr(2));
      number >> power;
      double below = 1;
      if (number.peek() == '/') {
        number.get();
        number >> below;
      }
      power /= below;
    }
    REQUIRE(std::string("MLT").find(word[0]) != std::string::npos);
    result *= std::pow(word[0] == 'M' ? mass : word[0] == 'L' ? length : time, power);
  }
  return result;
}

Value scaled(Value value, double by) {
  if (double* number = std::get_if<double>(&value)) *number *= by;
  if (Numbers* list = std::get_if<Numbers>(&value))
    for (double& number : *list) number *= by;
  return value;
}

Numbers numbers_of(const Value& value) {
  return std::holds_alternative<double>(value) ? Numbers{std::get<double>(value)} : std::get<Numbers>(value);
}

}  // namespace

TEST_CASE("measured in other units of mass, length and time, every theory says the same") {
  std::mt19937_64 engine(3);
  const auto random = [&] { return std::exp(6 * (static_cast<double>(engine() >> 11) * 0x1p-53 - 0.5)); };
  for (int trial = 0; trial < 5; ++trial) {
    const double mass = random(), length = random(), time = random();
    for (const Theory& theory : theories()) {
      if (theory.name == "radiation_printed") continue;
      INFO(theory.name);
      const Given given = generic(theory);
      Given other = given;
      for (const Field& field : theory.arguments)
        other[field.name] = scaled(given.at(field.name), factor(field.unit, mass, length, time));
      const auto here = theory.evaluate(given), there = theory.evaluate(other);
      for (std::size_t i = 0; i < theory.results.size(); ++i) {
        const Numbers a = numbers_of(here[i]), b = numbers_of(there[i]);
        REQUIRE(a.size() == b.size());
        for (std::size_t k = 0; k < a.size(); ++k)
          if (!std::isnan(a[k]))
            CHECK(std::abs(b[k] - a[k] * factor(theory.results[i].unit, mass, length, time)) <=
                  1e-9 * (std::abs(b[k]) + 1e-30));
      }
    }
  }
}

TEST_CASE("the printed law of radiation depends on the units") {
  const Theory& printed = *std::find_if(theories().begin(), theories().end(),
                                        [](const Theory& t) { return t.name == "radiation_printed"; });
  const Given given = generic(printed);
  Given other = given;
  for (const Field& field : printed.arguments)
    other[field.name] = scaled(given.at(field.name), factor(field.unit, 1, 10, 1));
  CHECK(std::abs(std::get<double>(printed.evaluate(other)[0]) / std::get<double>(printed.evaluate(given)[0]) - 1) >
        0.5);
}

TEST_CASE("every argument out of its range, or not finite, is an error that names it") {
  for (const Theory& theory : theories())
    for (const Field& field : theory.arguments) {
      INFO(theory.name << " " << field.name);
      std::vector<Value> wrong;
      if (field.type == "string")
        wrong.push_back(std::string("no such"));
      else {
        std::vector<double> bad{std::nan(""), -without_bound};
        if (!field.optional) bad.push_back(without_bound);
        if (field.range.min > any_number.min)
          bad.push_back(field.range.min_open ? field.range.min : field.range.min - 0.5);
        if (field.range.max < any_number.max)
          bad.push_back(field.range.max_open ? field.range.max : field.range.max + 0.5);
        for (const double x : bad) wrong.push_back(field.type == "numbers" ? Value(Numbers{x, x}) : Value(x));
        if (field.type == "numbers") wrong.push_back(Numbers{});
      }
      for (const Value& value : wrong) {
        Given given = generic(theory);
        given[field.name] = value;
        try {
          theory.evaluate(given);
          FAIL("no error");
        } catch (const FieldError& error) {
          CHECK(error.field == field.name);
        }
      }
    }
}

TEST_CASE("within its ranges a theory gives numbers or an error of a field, never NaN") {
  std::mt19937_64 engine(5);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  for (const Theory& theory : theories()) {
    static const std::set<std::string> slow{"maw_integrated", "maw_hertz", "disk_modes", "disk_mode_table",
                                            "modal_disk"};
    if (slow.count(theory.name)) continue;  // their arguments are bounded on both sides
    for (int trial = 0; trial < 200; ++trial) {
      Given given = generic(theory);
      for (const Field& field : theory.arguments) {
        const auto draw = [&] {
          const double low = std::max(field.range.min, -1e3), high = std::min(field.range.max, 1e6);
          const double u = uniform();
          if (u < 0.1 && !field.range.min_open) return low;
          if (u > 0.9 && !field.range.max_open && field.range.max < any_number.max) return high;
          return low >= 0 && high > 1e3 ? std::exp(-12 + 24 * uniform())
                                        : low + (high - low) * (0.001 + 0.998 * uniform());
        };
        if (field.type == "number") given[field.name] = draw();
        if (field.type == "numbers" && field.name != "psi1" && field.name != "at")
          for (double& x : std::get<Numbers>(given[field.name])) x = draw();
      }
      std::string shown = theory.name + ":";
      for (const auto& [name, value] : given)
        if (const double* number = std::get_if<double>(&value)) shown += " " + name + " = " + std::to_string(*number);
      INFO(shown);
      try {
        const auto values = theory.evaluate(given);
        for (std::size_t i = 0; i < values.size(); ++i)
          for (const double x : numbers_of(values[i]))
            CHECK((std::isfinite(x) || (theory.results[i].optional && std::isnan(x))));
      } catch (const FieldError& error) {
        CHECK(given.count(error.field) == 1);
      }
    }
  }
}

TEST_CASE("at the edge of what numbers hold a theory gives the right value or an error, never 0 in silence") {
  std::mt19937_64 engine(7);
  const auto power = [&] { return std::pow(10.0, static_cast<double>(engine() % 121) - 60); };
  for (const Theory& theory : theories()) {
    if (theory.name == "radiation_printed" || theory.name == "maw_integrated" || theory.name == "maw_hertz") continue;
    const Given given = generic(theory);
    const auto here = theory.evaluate(given);
    for (int trial = 0; trial < 100; ++trial) {
      const double mass = power(), length = power(), time = power();
      Given other = given;
      bool fits = true;
      for (const Field& field : theory.arguments) {
        other[field.name] = scaled(given.at(field.name), factor(field.unit, mass, length, time));
        if (!std::holds_alternative<std::string>(other[field.name]))
          for (const double x : numbers_of(other[field.name])) fits = fits && std::isnormal(x);
      }
      if (!fits) continue;
      INFO(theory.name << " at units " << mass << " " << length << " " << time);
      try {
        const auto there = theory.evaluate(other);
        for (std::size_t i = 0; i < theory.results.size(); ++i) {
          const Numbers a = numbers_of(here[i]), b = numbers_of(there[i]);
          for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
            if (!std::isnan(a[k]) && std::abs(a[k]) > 1e-30)
              CHECK(std::abs(b[k] / factor(theory.results[i].unit, mass, length, time) - a[k]) <=
                    1e-6 * std::abs(a[k]));
        }
      } catch (const Error& error) {
        CHECK_FALSE(std::string(error.what()).empty());
      }
    }
  }
}

TEST_CASE("every theory says where it holds and names a source in references.bib") {
  std::ifstream file(std::string(RICOCHET_SOURCE) + "/src/theory/references.bib");
  const std::string bib(std::istreambuf_iterator<char>(file), {});
  std::set<std::string> names;
  for (const Theory& theory : theories()) {
    INFO(theory.name);
    CHECK(names.insert(theory.name).second);
    CHECK((!theory.says.empty() && !theory.valid.empty() &&
           theory.example.starts_with("ricochet.theory." + theory.name + " {")));
    // Sources are separated by semicolons; each begins with its key, name and year, or with "here" or a remark.
    int known = 0;
    std::istringstream sources(theory.source + ";");
    for (std::string source; std::getline(sources >> std::ws, source, ';');) {
      const std::string key = source.substr(0, source.find_first_of(", "));
      if (!std::isdigit(static_cast<unsigned char>(key.back()))) continue;
      ++known;
      CHECK(bib.find("{" + key + ",") != std::string::npos);
    }
    CHECK((known > 0 || theory.source == "here"));
  }
}

TEST_CASE("every misprint says what is printed, what is right and how it was checked") {
  CHECK(errata().size() >= 17);
  for (const Misprint& misprint : errata())
    for (const char* text : {misprint.where, misprint.printed, misprint.right, misprint.checked})
      CHECK(std::string(text).size() > 4);
}

TEST_CASE("every claim says where it stands, what is printed, what can be had with its error, and by what") {
  CHECK(claims().size() >= 6);
  for (const Claim& claim : claims()) {
    for (const char* text : {claim.where, claim.printed, claim.had, claim.by}) CHECK(std::string(text).size() > 4);
    CHECK(std::string(claim.had).find_first_of("0123456789") != std::string::npos);
  }
}
