// Mistakes that the linter must find: lint_test runs it here and expects every one of them.
#include <string>
#include <vector>

int* nothing() { return 0; }                                  // modernize-use-nullptr
bool always(int x) { return x == x; }                         // misc-redundant-expression
bool empty(const std::vector<int>& v) { return v.size() == 0; }  // readability-container-size-empty
void copies(const std::vector<std::string>& names)
{
  for (const auto name : names) (void)name;                   // performance-for-range-copy
}
int BadName() { return 1; }                                   // readability-identifier-naming
double half(int x) { return x / 2; }                          // bugprone-integer-division
int divide() { const int zero = 0; return 1 / zero; }         // clang-analyzer-core.DivideZero
