// SPDX-License-Identifier: Apache-2.0
// Tests the isolation of drivers. If a driver crashes, hangs or ends its process, the program gets an error.
#include "core/isolation/isolated.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <system_error>

#include "core/os/child_process.h"
#include "core/render/registry.h"
#include "core/text/error.h"
#include "tests/refusal.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

// Behaviours of the fake driver, which misbehave() implements. The index of the device selects one. `conducts` is their
// number.
enum Conduct : int {
    draws,
    aborts,
    crashes,
    exits,
    hangs,
    refuses,
    lacks,
    dislikes,
    starves,
    orphans,
    scribbles,
    stops,
    fails,
    conducts
};
// The call in which the driver misbehaves.
enum class Where { listing, opening, drawing, releasing, nowhere };

void misbehave(Conduct conduct)
{
    std::fputs("driver: something is wrong\n", stderr);
    switch (conduct) {
        case aborts: std::abort();
        case crashes:
            std::signal(SIGSEGV, SIG_DFL);  // removes a sanitizer's handler
            raise(SIGSEGV);
            break;
        case exits: std::exit(0);
        case hangs:
            for (;;) pause();
        case refuses: throw Error("the driver refuses");
        case lacks: throw Unavailable("the driver has no double");
        case dislikes: throw InputError("--simd-width: the driver dislikes 3");
        case starves: throw std::bad_alloc();
        case orphans:
            if (fork() == 0) sleep(5);  // holds all descriptors
            std::_Exit(0);
        case scribbles:
            for (int descriptor = 3; descriptor < 100; ++descriptor) {
                for (int again = 0; again < 3; ++again) static_cast<void>(!write(descriptor, "x", 1));
            }
            break;
        case stops: kill(getppid(), SIGSTOP); std::_Exit(0);
        case fails: throw std::system_error(EAGAIN, std::generic_category());
        default: break;
    }
}

class MadeRenderer : public Renderer {
public:
    MadeRenderer(Conduct conduct, Where where) : conduct_(conduct), where_(where) {}
    ~MadeRenderer() override
    {
        if (where_ == Where::releasing) misbehave(conduct_);
    }

    // Renders a picture that depends on the scene. If the scene's detail level is -9, writes nothing into the image.
    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        if (where_ == Where::nowhere) std::puts("driver: junk on stdout");
        if (where_ == Where::drawing && scene.brightness != 1) misbehave(conduct_);
        for (std::size_t i = 0; i < image.bytes().size() && scene.detail != -9; ++i) {
            image.bytes()[i] = static_cast<std::uint8_t>(i * static_cast<std::size_t>(scene.iterations));
        }
        for (std::size_t i = 0; i < image.values().size(); ++i) image.values()[i].depth = static_cast<double>(i) / 3;
        progress(0.5);
        RenderStats report;
        report.backend = "made";
        report.device.name = scene.fractal == nullptr ? "" : "draws fractals";
        report.timings.kernel = 1.25;
        report.work.steps = 1ULL << 40;
        report.work.de_calls = locks_;
        return report;
    }

    // The lock writes to the memory when it is destroyed.
    std::shared_ptr<void> lock_memory(std::span<std::uint8_t> memory) override
    {
        ++locks_;
        return {memory.data(), [](std::uint8_t* first) { *static_cast<volatile std::uint8_t*>(first) = 0; }};
    }

private:
    std::uint64_t locks_ = 0;
    Conduct conduct_;
    Where where_;
};

class MadeBackend : public Backend {
public:
    MadeBackend(Where where, Conduct listing) : where_(where), listing_(listing) {}

    std::string_view name() const override { return "made"; }
    std::optional<std::string> unavailable() const override
    {
        if (where_ == Where::listing) misbehave(listing_);
        return std::nullopt;
    }
    std::vector<Device> devices() const override { return std::vector<Device>(conducts, {"made", "us", "0", true}); }
    std::unique_ptr<Renderer> do_create(const RendererOptions& options) const override
    {
        const auto conduct = static_cast<Conduct>(options.device);
        if (where_ == Where::opening) misbehave(conduct);
        return std::make_unique<MadeRenderer>(conduct, where_);
    }

private:
    Where where_;
    Conduct listing_;
};

std::unique_ptr<Backend> made(Where where, Conduct listing = draws)
{
    return isolated(std::make_unique<MadeBackend>(where, listing));
}

Scene scene_of(int width, int height)
{
    Scene scene = official_scene("bulb", width, height);
    scene.brightness = 1;
    return scene;
}

// Returns a scene for which the driver misbehaves when it renders.
Scene bad_scene()
{
    Scene scene = scene_of(8, 8);
    scene.brightness = 2;
    return scene;
}

class Isolation : public testing::Test {
protected:
    void SetUp() override { setenv("MANDELMARCH_DEVICE_TIMEOUT", "0.2", 1); }
    void TearDown() override { unsetenv("MANDELMARCH_DEVICE_TIMEOUT"); }

    // Renders 8 x 8 pixels. Returns false if they are black.
    bool drawn(Renderer& renderer, const Scene& scene = scene_of(8, 8), const Progress& progress = {})
    {
        std::ranges::fill(image.bytes(), std::uint8_t{0});
        renderer.render(scene, image, progress);
        return image.bytes()[1] != 0;
    }
    static Progress stopped()
    {
        std::stop_source source;
        source.request_stop();
        return Progress(source.get_token());
    }

    Image image{8, 8, Image::Layers::bytes};
};

TEST_F(Isolation, DrawsTheSamePictureAndReport)
{
    // The renderer is used after its backend was destroyed.
    const auto renderer = made(Where::nowhere)->create({.device = draws});
    for (const auto& [width, height, layers] : {std::tuple(5, 3, Image::Layers::all),
                                                {600, 400, Image::Layers::all},
                                                {600, 401, Image::Layers::bytes},
                                                {1, 1, Image::Layers::bytes}}) {
        const Scene scene = scene_of(width, height);
        Image here(width, height, layers);
        MadeRenderer(draws, Where::nowhere).render(scene, here, [](double) {});
        Image there(width, height, layers);
        double progress = 0;
        const RenderStats report = renderer->render(scene, there, [&](double share) { progress = share; });
        EXPECT_EQ(there.bytes(), here.bytes());
        if (layers == Image::Layers::all) {
            EXPECT_EQ(there.values().back().depth, here.values().back().depth);
        }
        EXPECT_EQ(progress, 0.5);
        EXPECT_EQ(report.device.name, "draws fractals");
        EXPECT_EQ(report.timings.kernel, 1.25);
        EXPECT_EQ(report.work.steps, 1ULL << 40);
    }
}

// Negative control of the previous test: if a driver writes no pixels, the image stays black. It does not show an
// earlier picture.
TEST_F(Isolation, APictureThatWasNotDrawnIsBlack)
{
    const auto renderer = made(Where::nowhere)->create({.device = draws});
    Scene scene = scene_of(8, 8);
    EXPECT_TRUE(drawn(*renderer, scene));
    scene.detail = -9;
    EXPECT_FALSE(drawn(*renderer, scene));
}

// Memory is locked for its second picture, and unlocked before other memory replaces it.
TEST_F(Isolation, MemoryIsLockedOnceForManyPictures)
{
    const auto renderer = made(Where::nowhere)->create({.device = draws});
    const auto locks = [&](int side) {
        Image picture(side, side, Image::Layers::bytes);
        return renderer->render(scene_of(side, side), picture).work.de_calls;
    };
    for (const auto& [side, expected] : {std::pair(8, 0), {8, 1}, {8, 1}, {600, 1}, {600, 2}, {500, 2}}) {
        EXPECT_EQ(locks(side), expected) << side;
    }
}

TEST_F(Isolation, ACancelledDrawingLeavesTheProcessAsItWas)
{
    const auto renderer = made(Where::nowhere)->create({.device = draws});
    EXPECT_THROW(drawn(*renderer, scene_of(8, 8), stopped()), Cancelled);
    EXPECT_EQ(image.bytes()[1], 0);
    // The next answer of the device process must belong to the next picture, not to the previous one.
    EXPECT_EQ(renderer->render(scene_of(8, 8), image).timings.kernel, 1.25);
    EXPECT_NE(image.bytes()[1], 0);
}

// The driver hangs and therefore sends no progress after the request to cancel. The render must end without waiting for
// the driver.
TEST_F(Isolation, CancellingADeviceThatHangsIsAnError)
{
    const auto renderer = made(Where::drawing)->create({.device = hangs});
    EXPECT_THROW(drawn(*renderer, bad_scene(), stopped()), Error);
}

TEST_F(Isolation, ErrorsKeepTheirTypeAndMessage)
{
    const auto backend = made(Where::opening);
    const auto create = [&](Conduct conduct) { return [&backend, conduct] { backend->create({.device = conduct}); }; };
    EXPECT_EQ(message_of<Error>(create(refuses)), "the driver refuses");
    EXPECT_EQ(message_of<Unavailable>(create(lacks)), "the driver has no double");
    EXPECT_EQ(message_of<InputError>(create(dislikes)), "--simd-width: the driver dislikes 3");
    EXPECT_NE(message_of<std::bad_alloc>(create(starves)), "");
    EXPECT_EQ(message_of<Error>(create(fails)), "backend made: Resource temporarily unavailable");
}

// A limit on the size of files, which is not a lack of memory, stops the shared memory of a picture.
TEST_F(Isolation, MemoryThatCannotBeSharedIsAnErrorWithItsCause)
{
    const auto renderer = made(Where::nowhere)->create({.device = draws});
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit all{};
    getrlimit(RLIMIT_FSIZE, &all);
    const rlimit small{.rlim_cur = 64, .rlim_max = all.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string why = message_of<Error>([&] { drawn(*renderer); });
    setrlimit(RLIMIT_FSIZE, &all);
    EXPECT_NE(why.find("File too large"), std::string::npos) << why;
}

TEST_F(Isolation, ProcessThatEndsIsAnErrorWithStageAndCause)
{
    const auto opening = made(Where::opening);
    const auto drawing = made(Where::drawing);
    for (const auto& [conduct, how] : std::vector<std::pair<Conduct, std::string>>{
             {aborts, "signal 6"}, {crashes, "signal 11"}, {exits, "exit code 0"}, {orphans, "exit code 0"}}) {
        const RendererOptions options{.device = conduct};
        const auto renderer = drawing->create(options);
        const auto other = drawing->create(options);
        const std::string why = message_of<Error>([&] { drawn(*renderer, bad_scene()); });
        const std::string place = "backend made: device " + std::to_string(conduct);
        for (const std::string& part :
             {place, std::string("while drawing"), how, std::string("its last words: driver: something is wrong")}) {
            EXPECT_NE(why.find(part), std::string::npos) << why;
        }
        const std::string before = message_of<Error>([&] { opening->create(options); });
        EXPECT_NE(before.find("while opening the device"), std::string::npos) << before;
        // Afterwards the same renderer renders in a new process. Another renderer of the device is not affected.
        EXPECT_TRUE(drawn(*renderer));
        EXPECT_TRUE(drawn(*other));
    }
}

// If SIGCHLD is ignored, the system does not report how processes end.
TEST_F(Isolation, CrashIsReportedIfSigchldIsIgnored)
{
    std::signal(SIGCHLD, SIG_IGN);
    const auto backend = made(Where::opening);
    const std::string why = message_of<Error>([&] { backend->create({.device = crashes}); });
    EXPECT_NE(why.find("signal 11"), std::string::npos) << why;
    EXPECT_THROW(ChildProcess({.words = {"false"}}).end(), Error);
    std::signal(SIGCHLD, SIG_DFL);
    EXPECT_EQ(ChildProcess({.words = {"false"}}).end().code, 1);
}

// The driver writes into all descriptors, or stops the process that has started its own.
TEST_F(Isolation, ADriverThatDisturbsOthersIsAnError)
{
    const auto other = made(Where::nowhere);
    const auto backend = made(Where::drawing);
    for (const Conduct conduct : {scribbles, stops}) {
        const auto renderer = backend->create({.device = conduct});
        EXPECT_THROW(drawn(*renderer, bad_scene()), Error);
        if (conduct == scribbles) {
            EXPECT_TRUE(drawn(*renderer));
        }
        EXPECT_TRUE(drawn(*other->create({.device = draws})));
    }
}

TEST_F(Isolation, ProcessThatEndsWhileListingIsAFailure)
{
    for (const Conduct conduct : {aborts, exits, hangs}) {
        const Listing listing = listing_of(*made(Where::listing, conduct));
        EXPECT_NE(listing.failure, "");
        EXPECT_EQ(listing.unavailable, "");
        EXPECT_TRUE(listing.devices.empty());
    }
}

TEST_F(Isolation, DeviceThatHungIsGivenUpAndAnotherRenders)
{
    const auto backend = made(Where::drawing);
    const auto renderer = backend->create({.device = hangs});
    const auto draw = [&] { drawn(*renderer, bad_scene()); };
    EXPECT_EQ(message_of<Error>(draw),
              "backend made: device 4: no answer within 0.2 s while drawing (MANDELMARCH_DEVICE_TIMEOUT)");
    EXPECT_EQ(message_of<Error>(draw), "backend made: device 4: it did not answer before and was given up");
    EXPECT_TRUE(drawn(*backend->create({.device = draws})));
}

TEST_F(Isolation, CrashOnReleaseDoesNotAffectPictures)
{
    const auto backend = made(Where::releasing);
    for (const Conduct conduct : {aborts, exits, hangs}) {
        for (int again = 0; again < 2; ++again) EXPECT_TRUE(drawn(*backend->create({.device = conduct})));
    }
}

TEST_F(Isolation, OutputOfDriversIsNotOnStandardOutput)
{
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const auto backend = made(Where::nowhere);
    for (const Conduct conduct : {draws, exits}) drawn(*backend->create({.device = conduct}));
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    static_cast<void>(testing::internal::GetCapturedStderr());
}

}  // namespace
}  // namespace mandelmarch
