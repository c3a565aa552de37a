// Makes the global locale write decimal commas and thousands points, as a German one does, while
// it lives. A locale of the system's own need not be installed for it.
#ifndef DHCAL_TESTS_SUPPORT_COMMA_LOCALE_H_
#define DHCAL_TESTS_SUPPORT_COMMA_LOCALE_H_

#include <locale>
#include <string>

namespace dhcal {

class CommaLocale {
 public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale(), new Punctuation))) {}
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;
  ~CommaLocale() { std::locale::global(before_); }

 private:
  class Punctuation : public std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };

  std::locale before_;
};

}  // namespace dhcal

#endif  // DHCAL_TESTS_SUPPORT_COMMA_LOCALE_H_
