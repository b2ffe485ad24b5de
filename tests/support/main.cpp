// The main program of every test executable. `--file=NAME` runs the tests that the source file NAME holds, and fails when it
// holds none: that is how CTest has one entry a file.
#include <cstdio>
#include <gtest/gtest.h>
#include <string>
#include <string_view>

namespace {

/// A filter that names every test of the source file.
std::string testsOf(std::string_view file) {
    std::string filter;
    const testing::UnitTest& all = *testing::UnitTest::GetInstance();
    for (int i = 0; i < all.total_test_suite_count(); ++i) {
        const testing::TestSuite& suite = *all.GetTestSuite(i);
        for (int j = 0; j < suite.total_test_count(); ++j) {
            const testing::TestInfo& test = *suite.GetTestInfo(j);
            if (std::string_view(test.file()).ends_with(file)) filter += std::string(suite.name()) + "." + test.name() + ":";
        }
    }
    return filter;
}

} // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    constexpr std::string_view option = "--file=";
    if (argc > 1 && std::string_view(argv[1]).starts_with(option)) {
        const std::string_view file = std::string_view(argv[1]).substr(option.size());
        GTEST_FLAG_SET(filter, testsOf(file));
        if (testing::UnitTest::GetInstance()->test_to_run_count() == 0 && testsOf(file).empty()) {
            std::fprintf(stderr, "no test comes from a file %s\n", argv[1] + option.size());
            return 1;
        }
    }
    return RUN_ALL_TESTS();
}
