// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// Numbers of the TIFF, Exif and DNG specifications, for those who read and those who write. [TIFF 6.0; Exif 2.3; DNG
// 1.4, chapter 4]

namespace srisp {

namespace tiff_tag {
enum : std::uint16_t {
    kNewSubfileType = 254,
    kImageWidth = 256,
    kImageLength = 257,
    kBitsPerSample = 258,
    kCompression = 259,
    kPhotometric = 262,
    kImageDescription = 270,
    kMake = 271,
    kModel = 272,
    kStripOffsets = 273,
    kOrientation = 274,
    kSamplesPerPixel = 277,
    kRowsPerStrip = 278,
    kStripByteCounts = 279,
    kPlanarConfiguration = 284,
    kSoftware = 305,
    kDateTime = 306,
    kArtist = 315,
    kPredictor = 317,
    kTileWidth = 322,
    kTileLength = 323,
    kTileOffsets = 324,
    kTileByteCounts = 325,
    kSubFolders = 330,
    kSampleFormat = 339,
    kXmp = 700,
    kCfaRepeatPatternDim = 33421,
    kCfaPattern = 33422,
    kCopyright = 33432,
    kExposureTime = 33434,
    kFNumber = 33437,
    kExifFolder = 34665,
    kGpsFolder = 34853,
    kIso = 34855,
    kExifVersion = 36864,
    kDngVersion = 50706,
    kDngBackwardVersion = 50707,
    kUniqueCameraModel = 50708,
    kCfaPlaneColor = 50710,
    kCfaLayout = 50711,
    kLinearizationTable = 50712,
    kBlackLevelRepeatDim = 50713,
    kBlackLevel = 50714,
    kBlackLevelDeltaH = 50715,
    kBlackLevelDeltaV = 50716,
    kWhiteLevel = 50717,
    kDefaultScale = 50718,
    kDefaultCropOrigin = 50719,
    kDefaultCropSize = 50720,
    kColorMatrix1 = 50721,
    kCameraCalibration1 = 50723,
    kAnalogBalance = 50727,
    kAsShotNeutral = 50728,
    kBaselineExposure = 50730,
    kCalibrationIlluminant1 = 50778,
    kActiveArea = 50829,
    kForwardMatrix1 = 50964,
    kPreviewColorSpace = 50970,
    kOpcodeList1 = 51008,
    kOpcodeList2 = 51009,
    kOpcodeList3 = 51022,
    kNoiseProfile = 51041,
    kKodakCfaPattern = 64777 ///< LibRaw takes it as kCfaPattern
};
} // namespace tiff_tag

constexpr int kPhotometricCfa = 32803, kPhotometricLinearRaw = 34892;
constexpr int kLargestDngSide = 65535;   ///< the limit is that of LibRaw, dcraw and JPEG
constexpr int kSmallestLibrawSide = 22;  ///< smaller images are none to LibRaw and dcraw
constexpr int kLargestBlackPattern = 64; ///< a side; real ones have 1, 2 or 6

} // namespace srisp
