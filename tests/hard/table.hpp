#pragma once
// The hard cases read, and are printed, as a table: what a case provokes, what counts as passing, what was measured,
// and the margin.

#include <string>

namespace ricochet::test {

/// A case of the table. Every criterion becomes a line of it, and a check.
class Case {
 public:
  Case(int number, std::string provokes) : number_(number), provokes_(std::move(provokes)) {}

  /// Passes if `measured` is at most `allowed`; the margin is their ratio.
  void at_most(double allowed, double measured, const std::string& criterion);
  /// Passes if all of `of` held.
  void all(int of, int held, const std::string& criterion);
  /// A figure that is reported, not judged.
  void told(double measured, const std::string& what);

 private:
  void add(const std::string& criterion, const std::string& allowed, const std::string& measured,
           const std::string& margin);

  int number_;
  std::string provokes_;
};

}  // namespace ricochet::test
