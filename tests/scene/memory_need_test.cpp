// A scene that cannot be in memory is refused when it is loaded, with what it needs and what there is.
#include "base/error.h"
#include "base/memory.h"
#include "scene/load/load.h"
#include "scene/load/memory_need.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <sys/resource.h>

namespace shadowbench {
namespace {

/// SHADOWBENCH_MAX_MEMORY_MIB, while the object lives.
class Memory {
public:
    explicit Memory(const char* mib) { ::setenv("SHADOWBENCH_MAX_MEMORY_MIB", mib, 1); }
    ~Memory() { ::unsetenv("SHADOWBENCH_MAX_MEMORY_MIB"); }
};

Scene sceneWith(const std::string& object, const std::string& size = "16") {
    return parseScene("title = \"x\"\nsize = " + size +
                          "\ncamera = { eye = [0, 9, 30], target = [0, 0, 0], fovy = 40, near = 0.1, far = 60 }\n"
                          "light = { kind = \"point\", centre = [1, 50, 2] }\n[[object]]\n" +
                          object,
                      "x.toml", Profile::Gate);
}

const std::string manyBalls =
    "mesh = { sphere = { radius = 0.01, triangles = 20000 } }\nscatter = { count = 5000, half = 10 }\n";

std::string refusal(const std::string& object, const std::string& size = "16") {
    try {
        sceneWith(object, size);
    } catch (const BadInput& error) {
        return error.what();
    }
    return "";
}

TEST(MemoryNeed, IsThatOfMeshesInstancesAndPixels) {
    const Scene one = sceneWith("mesh = { plane = { half = 1 } }\n");
    EXPECT_EQ(bytesOf(*one.objects[0].levels[0].mesh), 4U * 12 + 2U * 12);
    const Scene two = sceneWith("mesh = { plane = { half = 1 } }\nplace = [{ at = [0, 0, 0] }, { at = [3, 0, 0] }]\n");
    EXPECT_EQ(leastMemory(two) - leastMemory(one), 2U * 36) << "two triangles more, in the world";
    const Scene wide = sceneWith("mesh = { plane = { half = 1 } }\n", "[32, 16]");
    EXPECT_EQ(leastMemory(wide) - leastMemory(one), 16U * 16 * 76);
}

TEST(MemoryNeed, BeyondWhatThereIsIsRefusedWithBoth) {
    EXPECT_EQ(refusal(manyBalls), "") << "3.4 GiB";
    const Memory little("1024");
    const std::string said = refusal(manyBalls);
    EXPECT_NE(said.find("x.toml:5: object: the scene needs 3.4 GiB of memory at least, and there is 1.0 GiB"),
              std::string::npos)
        << said;
    EXPECT_NE(refusal("mesh = { plane = { half = 1 } }\n", "[8192, 8192]").find("needs 4.8 GiB"), std::string::npos);
}

TEST(MemoryNeed, OfMeshesAloneIsRefusedAtTheOneTooMany) {
    const Memory little("1");
    EXPECT_NE(
        refusal("mesh = { sphere = { radius = 1, triangles = 100000 } }\n").find("take 2 MiB of memory, and there is 1 MiB"),
        std::string::npos)
        << refusal("mesh = { sphere = { radius = 1, triangles = 100000 } }\n");
}

TEST(Memory, IsAsMuchAsTheLeastOfItsLimits) {
    const std::uint64_t there = memoryThere();
    EXPECT_GT(there, 64U << 20U);
    {
        const Memory little("64");
        EXPECT_EQ(memoryThere(), 64U << 20U);
    }
    rlimit before{};
    ::getrlimit(RLIMIT_AS, &before);
    const rlimit less{there / 2, before.rlim_max};
    ::setrlimit(RLIMIT_AS, &less);
    EXPECT_EQ(memoryThere(), there / 2);
    ::setrlimit(RLIMIT_AS, &before);
    EXPECT_EQ(inBytes(300U << 20U), "300 MiB");
    EXPECT_EQ(inBytes(std::uint64_t{3} << 29U), "1.5 GiB");
}

} // namespace
} // namespace shadowbench
