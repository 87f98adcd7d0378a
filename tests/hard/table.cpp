#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include "hard/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

namespace ricochet::test {
namespace {

struct Line {
  int number;
  std::string provokes, criterion, allowed, measured, margin;
};

std::vector<Line>& lines() {
  static std::vector<Line> list;
  return list;
}

struct PrintTable : Catch::TestEventListenerBase {
  using TestEventListenerBase::TestEventListenerBase;
  void testRunEnded(const Catch::TestRunStats&) override {
    std::vector<Line>& all = lines();
    std::stable_sort(all.begin(), all.end(), [](const Line& a, const Line& b) { return a.number < b.number; });
    std::size_t criterion = 9, measured = 8;
    for (const Line& l : all) {
      criterion = std::max(criterion, l.criterion.size());
      measured = std::max(measured, l.measured.size());
    }
    const auto print = [&](const std::string& text, const Line& l) {
      fmt::print("  {:<{}}  {:>{}}  {:>9}  {:>7}\n", text, criterion, l.measured, measured, l.allowed, l.margin);
    };
    int number = 0;
    if (!all.empty()) print("criterion", {0, "", "", "allowed", "measured", "margin"});
    for (const Line& l : all) {
      if (l.number != number) fmt::print("{:2} {}\n", l.number, l.provokes);
      number = l.number;
      print(l.criterion, l);
    }
    std::fflush(stdout);
  }
};
CATCH_REGISTER_LISTENER(PrintTable)

}  // namespace

void Case::add(const std::string& criterion, const std::string& allowed, const std::string& measured,
               const std::string& margin) {
  lines().push_back({number_, provokes_, criterion, allowed, measured, margin});
}

void Case::at_most(double allowed, double measured, const std::string& criterion) {
  const bool holds = measured <= allowed;
  add(criterion, fmt::format("{:.2g}", allowed), fmt::format("{:.2g}", measured),
      !holds          ? "MISSED"
      : measured == 0 ? "all"
                      : fmt::format("{:.2g}", allowed / measured));
  INFO(criterion << ": measured " << measured << ", allowed " << allowed);
  CHECK(holds);
}

void Case::all(int of, int held, const std::string& criterion) {
  add(criterion, fmt::format("{}", of), fmt::format("{}", held), held == of ? "all" : "MISSED");
  INFO(criterion << ": " << held << " of " << of);
  CHECK(held == of);
}

void Case::told(double measured, const std::string& what) { add(what, "", fmt::format("{:.2g}", measured), ""); }

}  // namespace ricochet::test
