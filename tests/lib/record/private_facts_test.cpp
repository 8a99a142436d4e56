// SPDX-License-Identifier: Apache-2.0
#include "record/private_facts.h"

#include <doctest/doctest.h>
#include <srisp/metadata.h>

#include "base/scene_linear_space.h"
#include "record/record.h"

using namespace srisp;

TEST_CASE("Where, by what device and whose a picture is are private; who made it, when and how are not")
{
    for (const char* name : { "GPS:Latitude",
                              "exif:GPSLatitude",
                              "drone-dji:GpsLatitude",
                              "Exif:BodySerialNumber",
                              "Exif:LensSerialNumber",
                              "aux:SerialNumber",
                              "aux:LensSerialNumber",
                              "Canon:SerialNumber",
                              "exifEX:BodySerialNumber",
                              "Exif:CameraOwnerName",
                              "aux:OwnerName",
                              "Canon:OwnerName",
                              "Exif:ImageUniqueID",
                              "Exif:MakerNote",
                              "HostComputer",
                              "IPTC:City",
                              "IPTC:Sublocation",
                              "photoshop:Country",
                              "IPTC:DocumentID",
                              "xmpMM:InstanceID",
                              "stRef:filePath",
                              "mwg-rs:Name",
                              "Iptc4xmpExt:PersonInImage",
                              "Raw profile type exif",
                              "XML:com.adobe.xmp",
                              "thumbnail_width",
                              "GCamera:hdrp_makernote" })
        CHECK_MESSAGE(is_private_fact(name), name);
    for (const char* name : { "Artist",
                              "Copyright",
                              "IPTC:Creator",
                              "IPTC:CopyrightNotice",
                              "ImageDescription",
                              "Keywords",
                              "Make",
                              "Model",
                              "DateTime",
                              "Exif:DateTimeOriginal",
                              "Exif:LensModel",
                              "FNumber",
                              "ExposureTime",
                              "Exif:ISOSpeedRatings",
                              "Orientation",
                              "XResolution",
                              "smpte:TimeCode",
                              "worldToCamera",
                              "Exif:UserComment",
                              "Software",
                              "unprocess:reference",
                              "IPTC:Credit",
                              "IPTC:Caption",
                              "dc:title",
                              "framesPerSecond",
                              "captureRate",
                              "isoSpeed",
                              "focus" })
        CHECK_FALSE_MESSAGE(is_private_fact(name), name);
}

TEST_CASE("Of absolute paths the last name is left, quoted or not; other words stay")
{
    CHECK(without_folders("srisptool /home/me/a.jpg --srisp-unprocess /refs/b.dng -o /out/c.exr") ==
          "srisptool a.jpg --srisp-unprocess b.dng -o c.exr");
    CHECK(without_folders("'/home/me too/a b.jpg' -o '../x/c d.exr'") == "'a b.jpg' -o '../x/c d.exr'");
    CHECK(without_folders("--srisp-unprocess:params=/home/me/look.json:seed=3 '/a/1.dng;/a/2.dng'") ==
          "--srisp-unprocess:params=look.json:seed=3 '1.dng;2.dng'");
    CHECK(without_folders("'--srisp-unprocess:params=/home/me too/look.json:seed=3' /refs/") ==
          "'--srisp-unprocess:params=look.json:seed=3' refs/");
    CHECK(without_folders("OpenImageIO 2.4.7.1 : oiiotool /home/me/x.jpg") == "OpenImageIO 2.4.7.1 : oiiotool x.jpg");
    for (const char* same :
         { "", "/", "a/b.jpg -o ../c.exr", "https://example.org/a/b", "1/60 f/8 -resize 50%x0", "'" })
        CHECK(without_folders(same) == same);
}

TEST_CASE("A result, its development and the development of a camera's own file hold none of it")
{
    OIIO::ImageSpec photo(4, 4, 3, OIIO::TypeFloat);
    photo.attribute("GPS:LatitudeRef", "N");
    photo.attribute("Exif:BodySerialNumber", "1234");
    photo.attribute("Artist", "me");
    photo.attribute("Software", "OpenImageIO 2.4.7.1 : oiiotool /home/me/x.jpg");
    photo.attribute("Exif:ImageHistory", "oiiotool '/home/me/my x.jpg' -o y.jpg");
    photo.attribute("DocumentName", "/home/me/x.jpg");
    OIIO::ImageSpec result = photo, processed = photo, developed = photo;
    mark_result(result, Direction::reverse);
    append_history(result, "srisptool /data/y.jpg -o /data/z.exr");
    append_notes(result, { "plain samples without a header, read as '/data/plate.json' says" });
    mark_result(processed, Direction::forward);
    record_development(developed, *find_scene_linear_space("ACEScg"), "");
    for (const OIIO::ImageSpec* spec : { &result, &processed, &developed }) {
        CHECK_FALSE(spec->find_attribute("GPS:LatitudeRef"));
        CHECK_FALSE(spec->find_attribute("Exif:BodySerialNumber"));
        CHECK(spec->get_string_attribute("Artist") == "me");
        CHECK(spec->get_string_attribute("Software") == "OpenImageIO 2.4.7.1 : oiiotool x.jpg");
        CHECK(spec->get_string_attribute("DocumentName") == "x.jpg");
    }
    CHECK(result.get_string_attribute("Exif:ImageHistory") == "oiiotool 'my x.jpg' -o y.jpg\nsrisptool y.jpg -o z.exr");
    CHECK(result.get_string_attribute(attribute::kNotes) ==
          "plain samples without a header, read as 'plate.json' says");
}
