// Whether a report of the sanitizers blames a library or us.
#include "tests/fuzz/fault.h"

#include <gtest/gtest.h>
#include <map>

namespace shadowbench::fuzz {
namespace {

/// Symbols of the program /b/fuzz.
std::string symbolOf(std::uintptr_t address) {
    static const std::map<std::uintptr_t, std::string> symbols{
        {0x10, "__asan_memcpy ??"},
        {0x15, "__asan_memmove /build/llvm-14/compiler-rt/lib/asan/asan_interceptors_memintrinsics.cpp"},
        {0x17, "StrtolFixAndCheck(void*, char const*, char**, char*, int) asan_interceptors.cpp.o"},
        {0x20, "operator new(unsigned long) <null>"},
        {0x25, "std::string::resize(unsigned long, char) /usr/include/c++/12/bits/basic_string.h"},
        {0x30, "shadowbench::(anonymous namespace)::addTriangles(shadowbench::Mesh&, aiMesh const&) /s/scene/read_mesh.cpp"},
        {0x40, "shadowbench::weld(shadowbench::Mesh const&) ??"},
        {0x50, "Assimp::MemoryIOStream::Read(void*, unsigned long, unsigned long) /usr/include/assimp/MemoryIOWrapper.h"}};
    return symbols.at(address);
}

std::string blamed(std::string_view stack) {
    const std::string report = "==7==ERROR: AddressSanitizer: heap-buffer-overflow on address 0x6020 (0x1+0x2)\n" +
                               std::string(stack) +
                               "\n0x6020 is located 0 bytes to the right of\nallocated by thread T0 here:\n"
                               "    #0 0x20  (/b/fuzz+0x20)\n    #1 0x30  (/b/fuzz+0x30)\n";
    return libraryAtFault(report, "/b/fuzz", symbolOf);
}

TEST(Fault, LiesInTheInnermostFunctionThatIsOursOrALibrarys) {
    EXPECT_EQ(blamed("    #0 0x99  (/usr/lib/libassimp.so.5+0x99)\n    #1 0x30  (/b/fuzz+0x30)\n"), "libassimp.so.5");
    EXPECT_EQ(blamed("    #0 0x30  (/b/fuzz+0x30)\n    #1 0x99  (/usr/lib/libassimp.so.5+0x99)\n"), "");
    EXPECT_EQ(blamed("    #0 0x50  (/b/fuzz+0x50)\n    #1 0x99  (/usr/lib/libassimp.so.5+0x99)\n"), "");
}

TEST(Fault, DoesNotLieInTemplatesOfTheCppLibrary) {
    EXPECT_EQ(blamed("    #0 0x25  (/b/fuzz+0x25)\n    #1 0x99  (/usr/lib/libOpenEXR.so.30+0x99)\n"), "libOpenEXR.so.30");
    EXPECT_EQ(blamed("    #0 0x25  (/b/fuzz+0x25)\n    #1 0x30  (/b/fuzz+0x30)\n"), "");
}

TEST(Fault, IsNoneWhereThereIsNoMemory) {
    const std::string report =
        "==7==ERROR: AddressSanitizer: allocator is out of memory trying to allocate 0x6f646e6a bytes\n"
        "    #0 0x30  (/b/fuzz+0x30)\n";
    EXPECT_NE(libraryAtFault(report, "/b/fuzz", symbolOf), "");
}

TEST(Fault, DoesNotLieInTheSanitizersOrTheCLibrary) {
    EXPECT_EQ(blamed("    #0 0x10  (/b/fuzz+0x10)\n    #1 0x99  (/usr/lib/libassimp.so.5+0x99)\n"), "libassimp.so.5");
    EXPECT_EQ(blamed("    #0 0x17  (/b/fuzz+0x17)\n    #1 0x99  (/usr/lib/libassimp.so.5+0x99)\n"), "libassimp.so.5");
    EXPECT_EQ(blamed("    #0 0x15  (/b/fuzz+0x15)\n    #1 0x99  (/usr/lib/libassimp.so.5+0x99)\n"), "libassimp.so.5");
    EXPECT_EQ(blamed("    #0 0x7f  (/lib/x86_64-linux-gnu/libc.so.6+0x7f)\n    #1 0x40  (/b/fuzz+0x40)\n"), "");
    EXPECT_EQ(
        blamed(
            "    #0 0x7f  (/lib/libc.so.6+0x7f) (BuildId: 0a)\n    #1 0x8f in _ZN4Imf  (/lib/libOpenEXR-3_1.so.30+0x8f)\n"),
        "libOpenEXR-3_1.so.30");
}

TEST(Fault, IsOursWhereNothingElseIsKnown) {
    EXPECT_EQ(blamed(""), ""); // and the stack of the allocation is another one
    EXPECT_EQ(libraryAtFault("Killed", "/b/fuzz", symbolOf), "");
}

} // namespace
} // namespace shadowbench::fuzz
