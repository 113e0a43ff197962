#include "scarf/core/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace scarf {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

using Words = std::map<std::string, std::string>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

template <class P>
P parsed(const std::string& name, const Words& words = {}) {
  const auto parameters = parse_parameters(name, words);
  if (!parameters || !std::holds_alternative<P>(*parameters)) {
    ADD_FAILURE() << name << ": " << (parameters ? "another representation" : parameters.error().message);
    return P{};
  }
  return std::get<P>(*parameters);
}

std::string refusal(const std::string& name, const Words& words) {
  const auto parameters = parse_parameters(name, words);
  if (parameters) {
    ADD_FAILURE() << name << " was accepted";
    return {};
  }
  EXPECT_EQ(parameters.error().code, ErrorCode::illegal_parameter);
  EXPECT_THAT(parameters.error().message, Not(HasSubstr("\n")));
  return parameters.error().message;
}

bool legal(const Parameters& parameters) {
  const auto checked = checked_parameters(parameters);
  if (!checked) {
    EXPECT_EQ(checked.error().code, ErrorCode::illegal_parameter);
  }
  return checked.ok();
}

TEST(Registry, NamesInTheOrderOfTheVariant) {
  std::vector<std::string> names;
  for (const RepresentationInfo& info : representations()) names.push_back(info.name);
  EXPECT_THAT(names, ElementsAre("scarf", "time_window", "sae", "eros", "tos", "sits", "chain_sae", "aed_sae",
                                 "aae"));
  for (size_t i = 0; i < names.size(); ++i) {
    const auto defaults = parse_parameters(names[i]);
    ASSERT_TRUE(defaults) << defaults.error().message;
    EXPECT_EQ(defaults->index(), i);
    EXPECT_EQ(&info_of(*defaults), &representations()[i]);
  }
}

TEST(Registry, WhatIsExactAndWhatKeepsEvents) {
  for (const RepresentationInfo& info : representations()) {
    EXPECT_EQ(info.exact, info.name != "aed_sae" && info.name != "aae") << info.name;
    EXPECT_EQ(info.has_events, info.name == "scarf" || info.name == "time_window" || info.name == "aae")
        << info.name;
  }
}

TEST(Registry, EveryParameterIsDescribed) {
  for (const RepresentationInfo& info : representations()) {
    EXPECT_THAT(info.title, Not(IsEmpty())) << info.name;
    EXPECT_THAT(info.description, AllOf(Not(IsEmpty()), Not(HasSubstr("\n")))) << info.name;
    EXPECT_THAT(info.parameters, Not(IsEmpty())) << info.name;
    for (const ParameterInfo& parameter : info.parameters) {
      EXPECT_THAT(parameter.name, Not(HasSubstr("_"))) << "words have dashes";
      EXPECT_THAT(parameter.range, Not(IsEmpty())) << info.name << " " << parameter.name;
      EXPECT_THAT(parameter.description, AllOf(Not(IsEmpty()), Not(HasSubstr("\n"))))
          << info.name << " " << parameter.name;
    }
  }
}

TEST(Registry, DefaultsReadThemselves) {
  for (const RepresentationInfo& info : representations()) {
    if (info.name == "scarf") continue;  // what a preset does not use has no default
    for (const ParameterInfo& parameter : info.parameters) {
      const auto given = parse_parameters(info.name, {{parameter.name, parameter.value}});
      EXPECT_TRUE(given) << info.name << " " << parameter.name << " " << parameter.value;
    }
  }
}

TEST(Defaults, AreThePapers) {
  EXPECT_EQ(parsed<ScarfParameters>("scarf").preset, Preset::paper);
  EXPECT_EQ(parsed<ScarfParameters>("scarf").accumulation, 0.3);
  EXPECT_FALSE(parsed<ScarfParameters>("scarf").grid.cell.has_value());
  EXPECT_EQ(parsed<TimeWindowParameters>("time_window").window, 33'000);
  EXPECT_FALSE(parsed<TimeWindowParameters>("time_window").counts);
  EXPECT_EQ(parsed<SaeParameters>("sae").tau, 33'000);
  EXPECT_EQ(parsed<SaeParameters>("sae").decay, SaeParameters::Decay::exponential);
  EXPECT_EQ(parsed<ErosParameters>("eros").kernel, 9);
  EXPECT_EQ(parsed<ErosParameters>("eros").decay, 0.3);
  EXPECT_EQ(parsed<TosParameters>("tos").kernel, 9);
  EXPECT_EQ(parsed<TosParameters>("tos").decay, 2);
  EXPECT_EQ(parsed<SitsParameters>("sits").kernel, 9);
  EXPECT_EQ(parsed<SitsParameters>("sits").rule, SitsParameters::Rule::paper);
  EXPECT_EQ(parsed<ChainSaeParameters>("chain_sae").rule, ChainSaeParameters::Rule::paper);
  EXPECT_FALSE(parsed<ChainSaeParameters>("chain_sae").linear);
  EXPECT_EQ(parsed<AedSaeParameters>("aed_sae").window, 300'000);
  EXPECT_EQ(parsed<AedSaeParameters>("aed_sae").lambda, 0.3);
  EXPECT_EQ(parsed<AaeParameters>("aae").block, 15);
  EXPECT_FALSE(parsed<AaeParameters>("aae").keep);
  EXPECT_FALSE(parsed<AaeParameters>("aae").esvo2);
}

TEST(Words, EveryFieldCanBeGiven) {
  const auto scarf = parsed<ScarfParameters>("scarf", {{"preset", "event_driven_flex"},
                                                       {"cell", "7"},
                                                       {"ratio", "0.5"},
                                                       {"alpha", "1.5"},
                                                       {"accumulation", "0.25"}});
  EXPECT_EQ(scarf.preset, Preset::event_driven_flex);
  EXPECT_EQ(scarf.grid.cell, 7);
  EXPECT_EQ(scarf.grid.ratio, 0.5);
  EXPECT_EQ(scarf.grid.alpha, 1.5);
  EXPECT_EQ(scarf.accumulation, 0.25);
  const auto window = parsed<TimeWindowParameters>(
      "time_window", {{"window", "5000"}, {"counts", "true"}, {"accumulation", "1e-2"}});
  EXPECT_EQ(window.window, 5'000);
  EXPECT_TRUE(window.counts);
  EXPECT_EQ(window.accumulation, 0.01);
  const auto sae = parsed<SaeParameters>("sae", {{"decay", "linear"}, {"tau", "12ms"}});
  EXPECT_EQ(sae.decay, SaeParameters::Decay::linear);
  EXPECT_EQ(sae.tau, 12'000);
  const auto eros = parsed<ErosParameters>("eros", {{"kernel", "63"}, {"decay", "0.999"}});
  EXPECT_EQ(eros.kernel, 63);
  EXPECT_EQ(eros.decay, 0.999);
  const auto tos = parsed<TosParameters>("tos", {{"kernel", "3"}, {"decay", "84.5"}});
  EXPECT_EQ(tos.kernel, 3);
  EXPECT_EQ(tos.decay, 84.5);
  for (const auto& [word, rule] : {std::pair{"paper", SitsParameters::Rule::paper},
                                   {"greater", SitsParameters::Rule::greater},
                                   {"event_driven", SitsParameters::Rule::event_driven}}) {
    EXPECT_EQ(parsed<SitsParameters>("sits", {{"rule", word}, {"kernel", "5"}}).rule, rule);
  }
  const auto chain = parsed<ChainSaeParameters>("chain_sae", {{"rule", "event_driven"}, {"linear", "true"}});
  EXPECT_EQ(chain.rule, ChainSaeParameters::Rule::event_driven);
  EXPECT_TRUE(chain.linear);
  const auto aed = parsed<AedSaeParameters>("aed_sae", {{"window", "2s"}, {"lambda", "0.75"}});
  EXPECT_EQ(aed.window, 2'000'000);
  EXPECT_EQ(aed.lambda, 0.75);
  const auto aae = parsed<AaeParameters>("aae", {{"block", "1024"}, {"keep", "true"}, {"esvo2", "false"}});
  EXPECT_EQ(aae.block, 1'024);
  EXPECT_TRUE(aae.keep);
  EXPECT_FALSE(aae.esvo2);
  EXPECT_TRUE(parsed<AaeParameters>("aae", {{"esvo2", "true"}}).esvo2);
}

TEST(Words, TimesWithUnits) {
  const auto window = [](const std::string& word) {
    return parsed<TimeWindowParameters>("time_window", {{"window", word}}).window;
  };
  EXPECT_EQ(window("250"), 250);
  EXPECT_EQ(window("250us"), 250);
  EXPECT_EQ(window("33ms"), 33'000);
  EXPECT_EQ(window("1.5ms"), 1'500);
  EXPECT_EQ(window("0.000001s"), 1);
  EXPECT_EQ(window(".25ms"), 250);
  EXPECT_EQ(window("7.000"), 7);
  EXPECT_EQ(window("99.9999990s"), 99'999'999);
  EXPECT_EQ(window("100s"), 100'000'000);
  for (const std::string word :
       {"", "ms", ".", ".s", "-5ms", "+5ms", "5 ms", "0.5us", "1.0000001s", "1.5.5s", "5m", "5minutes",
        "5ms5", "5us ", "0x10", "1e400", "nan", "9223372036855s"}) {
    EXPECT_EQ(refusal("time_window", {{"window", word}}),
              "time_window: window is '" + word + "', legal is 1us to 100s");
  }
}

TEST(Words, WhatIsRefusedAndHow) {
  EXPECT_THAT(refusal("eross", {}), AllOf(HasSubstr("eross"), HasSubstr("eros"), HasSubstr("chain_sae")));
  EXPECT_THAT(refusal("", {}), HasSubstr("scarf"));
  EXPECT_THAT(refusal("EROS", {}), HasSubstr("eros"));
  EXPECT_THAT(refusal("eros", {{"lambda", "1"}}),
              AllOf(HasSubstr("eros"), HasSubstr("lambda"), HasSubstr("kernel"), HasSubstr("decay")));
  EXPECT_THAT(refusal("eros", {{"kernel", "nine"}}), AllOf(HasSubstr("kernel"), HasSubstr("nine")));
  EXPECT_THAT(refusal("eros", {{"kernel", "9.5"}}), HasSubstr("kernel"));
  EXPECT_THAT(refusal("eros", {{"kernel", "9 "}}), HasSubstr("kernel"));
  EXPECT_THAT(refusal("eros", {{"kernel", ""}}), HasSubstr("kernel"));
  EXPECT_THAT(refusal("eros", {{"kernel", "99999999999"}}), HasSubstr("kernel"));
  EXPECT_THAT(refusal("eros", {{"decay", "0,3"}}), HasSubstr("decay"));
  EXPECT_THAT(refusal("eros", {{"decay", "nan"}}), HasSubstr("decay"));
  EXPECT_THAT(refusal("eros", {{"kernel", "65"}}),
              AllOf(HasSubstr("eros"), HasSubstr("kernel"), HasSubstr("65"), HasSubstr("63")));
  EXPECT_THAT(refusal("sits", {{"rule", "less"}}),
              AllOf(HasSubstr("less"), HasSubstr("paper"), HasSubstr("greater"), HasSubstr("event_driven")));
  EXPECT_THAT(refusal("chain_sae", {{"rule", "greater"}}), HasSubstr("paper"));
  EXPECT_THAT(refusal("sae", {{"decay", "0.3"}}), AllOf(HasSubstr("exponential"), HasSubstr("linear")));
  EXPECT_THAT(refusal("aae", {{"keep", "maybe"}}), AllOf(HasSubstr("keep"), HasSubstr("true")));
  EXPECT_THAT(refusal("scarf", {{"preset", "papers"}}), AllOf(HasSubstr("papers"), HasSubstr("paper")));
  EXPECT_THAT(refusal("scarf", {{"ratio", ""}}), HasSubstr("ratio is ''"));
  EXPECT_THAT(refusal("aed_sae", {{"lambda", "1 "}}), HasSubstr("lambda is '1 '"));
}

TEST(Words, OneFormOfMessages) {
  EXPECT_EQ(refusal("eross", {}),
            "representation 'eross' is unknown; use one of scarf, time_window, sae, eros, tos, sits, "
            "chain_sae, aed_sae, aae");
  EXPECT_EQ(refusal("eros", {{"lambda", "1"}}),
            "eros: parameter 'lambda' is unknown; use one of kernel, decay");
  EXPECT_EQ(refusal("sits", {{"kernel", "64"}}),
            "sits: kernel is 64, legal is odd, 3 to 63 (an even number is raised by 1)");
  EXPECT_EQ(refusal("sits", {{"rule", "less"}}),
            "sits: rule is 'less', legal is paper, greater, event_driven");
  EXPECT_EQ(refusal("aae", {{"keep", "1"}}), "aae: keep is '1', legal is false, true");
  EXPECT_EQ(refusal("scarf", {{"cell", "129"}}), "scarf: cell is 129, legal is 1 to 128");
  const auto rule = checked_parameters(SitsParameters{.rule = static_cast<SitsParameters::Rule>(3)});
  ASSERT_FALSE(rule);
  EXPECT_EQ(rule.error().message, "sits: rule is 3, legal is paper, greater, event_driven");
}

TEST(Words, WhatIsLegalDependsOnAllOfThem) {
  // A decay of 50 is too much for the default kernel.
  EXPECT_EQ(parsed<TosParameters>("tos", {{"decay", "50"}, {"kernel", "3"}}).decay, 50);
}

TEST(Ranges, Kernels) {
  const auto eros = [](int32_t k) { return legal(ErosParameters{.kernel = k}); };
  const auto sits = [](int32_t k) { return legal(SitsParameters{.kernel = k}); };
  const auto tos = [](int32_t k) { return legal(TosParameters{.kernel = k, .decay = 1}); };
  for (int32_t k : {3, 4, 9, 62, 63}) {
    EXPECT_TRUE(eros(k) && sits(k) && tos(k)) << k;
  }
  for (int32_t k : {-9, 0, 1, 64, 65, std::numeric_limits<int32_t>::max()}) {
    EXPECT_FALSE(eros(k) || sits(k) || tos(k)) << k;
  }
}

TEST(Ranges, EvenKernelsAreRaised) {
  const auto kernel = [](const Parameters& parameters) {
    const auto checked = checked_parameters(parameters);
    EXPECT_TRUE(checked);
    if (const auto* eros = std::get_if<ErosParameters>(&*checked)) return eros->kernel;
    if (const auto* tos = std::get_if<TosParameters>(&*checked)) return tos->kernel;
    return std::get<SitsParameters>(*checked).kernel;
  };
  EXPECT_EQ(kernel(ErosParameters{.kernel = 8}), 9);
  EXPECT_EQ(kernel(TosParameters{.kernel = 8}), 9);
  EXPECT_EQ(kernel(SitsParameters{.kernel = 62}), 63);
  EXPECT_EQ(kernel(SitsParameters{.kernel = 7}), 7);
  EXPECT_EQ(parsed<ErosParameters>("eros", {{"kernel", "4"}}).kernel, 5);
}

TEST(Ranges, Decays) {
  const auto eros = [](double d) { return legal(ErosParameters{.decay = d}); };
  EXPECT_TRUE(eros(1e-300) && eros(0.5) && eros(std::nextafter(1.0, 0.0)));
  EXPECT_FALSE(eros(0) || eros(1) || eros(-0.3) || eros(kNan) || eros(kInf));
  const auto tos = [](int32_t k, double decay) { return legal(TosParameters{.kernel = k, .decay = decay}); };
  EXPECT_TRUE(tos(9, 28.3) && tos(3, 84.99) && tos(63, 4));
  EXPECT_FALSE(tos(9, 28.4) || tos(3, 85) || tos(63, 4.1) || tos(9, 0) || tos(9, -1) || tos(9, kNan));
  EXPECT_FALSE(tos(8, 30)) << "8 is raised to 9, and 270 is too much";
  EXPECT_THAT(refusal("tos", {{"decay", "30"}}),
              AllOf(HasSubstr("tos"), HasSubstr("decay"), HasSubstr("255")));
}

TEST(Ranges, TimesAndTheRest) {
  const auto window = [](int64_t w) { return legal(TimeWindowParameters{.window = w}); };
  EXPECT_TRUE(window(1) && window(100'000'000));
  EXPECT_FALSE(window(0) || window(-1) || window(100'000'001));
  const auto tau = [](int64_t t) { return legal(SaeParameters{.tau = t}); };
  EXPECT_TRUE(tau(1) && tau(10'000'000));
  EXPECT_FALSE(tau(0) || tau(10'000'001));
  const auto span = [](int64_t t) { return legal(AedSaeParameters{.window = t}); };
  EXPECT_TRUE(span(1'000) && span(100'000'000));
  EXPECT_FALSE(span(999) || span(100'000'001));
  const auto lambda = [](double l) { return legal(AedSaeParameters{.lambda = l}); };
  EXPECT_TRUE(lambda(1e-9) && lambda(1e9));
  EXPECT_FALSE(lambda(0) || lambda(-1) || lambda(kInf) || lambda(kNan));
  const auto block = [](int32_t b) { return legal(AaeParameters{.block = b}); };
  EXPECT_TRUE(block(1) && block(1'024));
  EXPECT_FALSE(block(0) || block(1'025));
  const auto accumulation = [](double c) {
    return legal(TimeWindowParameters{.counts = true, .accumulation = c});
  };
  EXPECT_TRUE(accumulation(0.3));
  EXPECT_FALSE(accumulation(0) || accumulation(-1) || accumulation(kNan) || accumulation(kInf));
  EXPECT_THAT(refusal("time_window", {{"window", "0"}}),
              AllOf(HasSubstr("time_window"), HasSubstr("window")));
  EXPECT_THAT(refusal("aed_sae", {{"lambda", "0"}}), AllOf(HasSubstr("aed_sae"), HasSubstr("lambda")));
  EXPECT_THAT(refusal("aae", {{"block", "1025"}}), AllOf(HasSubstr("aae"), HasSubstr("1024")));
}

}  // namespace
}  // namespace scarf
