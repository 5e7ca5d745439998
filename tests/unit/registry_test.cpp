// SPDX-License-Identifier: Apache-2.0
// What programs rely on in every backend: its BackendInfo, by which programs select it, also through a wrapper; that it
// is unavailable if it is not built; and that a render can be cancelled.
#include "core/render/registry.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "backends/all.h"
#include "core/isolation/isolated.h"
#include "core/text/error.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

// A fake backend with the given information and one device, which renders nothing.
class Made : public Backend {
public:
    Made(std::string name, BackendInfo info, bool has_gpu = false)
        : name_(std::move(name)), info_(std::move(info)), has_gpu_(has_gpu)
    {
    }

    std::string_view name() const override { return name_; }
    BackendInfo info() const override { return info_; }
    std::vector<InstalledDriver> installed_drivers() const override
    {
        return {{"made", "made.icd", "libmade.so", "1"}};
    }
    std::optional<std::string> unavailable() const override { return std::nullopt; }
    std::vector<Device> devices() const override { return {{"made", "", "", has_gpu_}}; }
    std::unique_ptr<Renderer> do_create(const RendererOptions&) const override
    {
        throw Unavailable("it draws nothing");
    }

private:
    std::string name_;
    BackendInfo info_;
    bool has_gpu_;
};

// A backend that ends the process as soon as its driver is queried.
class Crashing : public Made {
public:
    using Made::Made;
    std::optional<std::string> unavailable() const override { std::abort(); }
    std::vector<Device> devices() const override { std::abort(); }
};

template <class... Backends>
Registry registry_of(Backends... backends)
{
    std::vector<std::unique_ptr<Backend>> all;
    (all.push_back(std::make_unique<Backends>(std::move(backends))), ...);
    return Registry(std::move(all));
}

TEST(BackendInfo, PassThroughIsolationWithoutADevice)
{
    const BackendInfo info{.role = Role::accelerator, .build = {.compiler = "a compiler"}};
    const auto isolated_one = isolated(std::make_unique<Crashing>("made", info));
    EXPECT_EQ(isolated_one->info().role, Role::accelerator);
    EXPECT_EQ(isolated_one->info().build.compiler, "a compiler");
    EXPECT_EQ(isolated_one->installed_drivers().at(0).library, "libmade.so");
    EXPECT_THROW(isolated_one->devices(), Error) << "its driver crashes, and was not opened for the properties";
    EXPECT_EQ(without_backend("made", "not built")->info().build.compiler, "");
}

TEST(BackendInfo, EveryBuiltBackendHasCompilerAndFlags)
{
    const Registry registry = all_backends();
    EXPECT_EQ(registry.with(Role::reference).name(), "reference");
    EXPECT_EQ(registry.with(Role::host).name(), "openmp");
    for (const auto& backend : registry.backends()) {
        const KernelBuild build = backend->info().build;
        if (backend->unavailable().value_or("").starts_with("not built")) continue;
        EXPECT_FALSE(build.compiler.empty() || build.exact.empty() || build.fast.empty()) << backend->name();
        EXPECT_FALSE(backend->info().title.empty() || backend->info().distribution.empty()) << backend->name();
    }
}

// A driver that is open in this process would hang in a process forked from it.
TEST(ProgramBackends, AreRefusedAfterDriversWereOpenedHere)
{
    const Registry here = all_backends();
    EXPECT_THROW(program_backends(0, nullptr), Error);
}

TEST(Automatic, TakesTheFirstAcceleratorWithAGpuElseTheHost)
{
    const Made host("cores", {.role = Role::host});
    const Made idle("first", {.role = Role::accelerator, .gpus = "made GPU"});
    const Made ready("second", {.role = Role::accelerator}, true);
    const Made plain("third", {}, true);
    const Registry with_gpu = registry_of(plain, host, idle, ready);
    EXPECT_EQ(with_gpu.automatic().backend->name(), "second");
    EXPECT_EQ(with_gpu.automatic().reason, "GPU made");
    const Registry without = registry_of(plain, idle, host);
    EXPECT_EQ(without.automatic().backend->name(), "cores") << "a GPU counts only for an accelerator";
    EXPECT_EQ(without.automatic().reason, "no made GPU here");
    EXPECT_EQ(registry_of(host).automatic().reason, "this build has no accelerator");
    EXPECT_THROW(registry_of(idle).automatic(), Unavailable);
}

TEST(Registry, BackendsAndDevicesThatAreMissingAreUnavailable)
{
    const Registry registry = all_backends();
    for (const auto& backend : registry.backends()) {
        if (!backend->unavailable()) {
            const int devices = static_cast<int>(backend->devices().size());
            EXPECT_GT(devices, 0);
            EXPECT_THROW(backend->create({.device = devices}), Unavailable) << backend->name();
            continue;
        }
        EXPECT_THROW(backend->create({}), Unavailable) << backend->name();
    }
    EXPECT_EQ(registry.find("nothing"), nullptr);
    EXPECT_THROW(registry.find("reference")->create({.precision = Precision::f32}), Unavailable);
}

// The picture is a single band, so openmp ends between tiles, before the first one.
TEST(Cancelling, EveryBackendEndsAndDrawsAgain)
{
    const Registry registry = all_backends();
    const Scene scene = official_scene("bulb", 40, 30);
    const auto is_black = [](const Image& image) {
        return std::ranges::all_of(image.bytes(), [](std::uint8_t byte) { return byte == 0; });
    };
    for (const auto& backend : registry.backends()) {
        if (backend->unavailable()) continue;
        SCOPED_TRACE(backend->name());
        const auto renderer = backend->create({});
        Image image(40, 30, Image::Layers::bytes);
        std::stop_source source;
        source.request_stop();
        EXPECT_THROW(renderer->render(scene, image, Progress(source.get_token())), Cancelled);
        EXPECT_TRUE(is_black(image) || backend->name() != "openmp");
        EXPECT_NO_THROW(renderer->render(scene, image, Progress(std::stop_source().get_token())));
        EXPECT_FALSE(is_black(image));
    }
}

}  // namespace
}  // namespace mandelmarch
