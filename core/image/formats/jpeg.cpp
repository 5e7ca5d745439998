// SPDX-License-Identifier: Apache-2.0
// JPEG through libjpeg: quality 95, no chroma subsampling, rows from the top down.
// clang-format off: jpeglib.h needs declarations of stdio.h
#include <cstdio>
#include <jpeglib.h>
// clang-format on
#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <exception>

#include "core/image/formats/formats.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

constexpr int jpeg_quality = 95;

// Error handler for libjpeg. It must not return, so it jumps back to compress().
struct JpegErrors {
    jpeg_error_mgr manager;
    std::jmp_buf back;
    std::array<char, JMSG_LENGTH_MAX> text;

    static void leave(j_common_ptr info)
    {
        auto* errors = reinterpret_cast<JpegErrors*>(info->err);
        info->err->format_message(info, errors->text.data());
        std::longjmp(errors->back, 1);
    }
};

// Receives libjpeg's output and writes it to the file. Exceptions must not pass through C code, so the first error of
// the file is stored.
struct JpegSink {
    jpeg_destination_mgr manager;
    OutputFile* file;
    std::exception_ptr error;
    std::array<JOCTET, 1 << 16> buffer;

    void begin()
    {
        manager.next_output_byte = buffer.data();
        manager.free_in_buffer = buffer.size();
    }
    bool take(std::size_t size)
    {
        try {
            file->write(buffer.data(), size);
            return true;
        } catch (...) {
            error = std::current_exception();
            return false;
        }
    }

    static JpegSink& of(j_compress_ptr info) { return *reinterpret_cast<JpegSink*>(info->dest); }
    static void start(j_compress_ptr info) { of(info).begin(); }
    static boolean empty(j_compress_ptr info)
    {
        JpegSink& sink = of(info);
        if (!sink.take(sink.buffer.size())) JpegErrors::leave(reinterpret_cast<j_common_ptr>(info));
        sink.begin();
        return TRUE;
    }
    static void end(j_compress_ptr info)
    {
        JpegSink& sink = of(info);
        if (!sink.take(sink.buffer.size() - sink.manager.free_in_buffer)) {
            JpegErrors::leave(reinterpret_cast<j_common_ptr>(info));
        }
    }
};

// Compresses the picture. Returns false if libjpeg reported an error. Contains no objects with destructors, because
// longjmp() would skip the destructors.
bool compress(jpeg_compress_struct& info, JpegErrors& errors, const Image& image)
{
    if (setjmp(errors.back) != 0) return false;
    info.image_width = static_cast<JDIMENSION>(image.width());
    info.image_height = static_cast<JDIMENSION>(image.height());
    info.input_components = 3;
    info.in_color_space = JCS_RGB;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, jpeg_quality, TRUE);
    for (int c = 0; c < info.num_components; ++c) {
        info.comp_info[c].h_samp_factor = 1;
        info.comp_info[c].v_samp_factor = 1;
    }
    jpeg_start_compress(&info, TRUE);
    while (info.next_scanline < info.image_height) {
        const std::size_t y = info.image_height - 1 - info.next_scanline;
        // libjpeg does not modify the row.
        auto* row = const_cast<JSAMPLE*>(image.bytes().data() + 3 * y * info.image_width);
        jpeg_write_scanlines(&info, &row, 1);
    }
    jpeg_finish_compress(&info);
    return true;
}

}  // namespace

void write_jpeg(OutputFile& file, const std::string& path, const Image& image)
{
    JpegErrors errors{};
    jpeg_compress_struct info{};
    info.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = JpegErrors::leave;
    jpeg_create_compress(&info);
    JpegSink sink{};
    sink.file = &file;
    sink.manager.init_destination = JpegSink::start;
    sink.manager.empty_output_buffer = JpegSink::empty;
    sink.manager.term_destination = JpegSink::end;
    info.dest = &sink.manager;
    const bool written = compress(info, errors, image);
    jpeg_destroy_compress(&info);
    if (sink.error) std::rethrow_exception(sink.error);
    if (!written) throw Error(fmt::format("{}: cannot write JPEG: {}", path, errors.text.data()));
}

}  // namespace mandelmarch
