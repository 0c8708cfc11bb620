// Damage to files, as disks, networks and editors do it, and repairs that carry it behind the checks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>

#include "studies/results/detail/seal.hpp"

namespace gamut {

/// Some bytes flipped, the end cut off, a block of zeros, two blocks swapped, one doubled.
inline std::string damaged(std::string bytes, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const std::size_t block = std::min<std::size_t>(std::size_t{1} << below(13), bytes.size() / 2);
  const auto place = [&] { return below(bytes.size() - block); };
  switch (below(5)) {
    case 0:
      for (std::size_t i = 0, n = 1 + below(8); i < n; ++i)
        bytes[below(bytes.size())] ^= static_cast<char>(1U << below(8));
      break;
    case 1:
      bytes.resize(below(bytes.size()));
      break;
    case 2:
      bytes.replace(place(), block, block, '\0');
      break;
    case 3: {
      const std::size_t a = place(), b = place();
      const std::string first = bytes.substr(a, block), second = bytes.substr(b, block);
      bytes.replace(a, block, second).replace(b, block, first);
      break;
    }
    default: {
      const std::string repeated = bytes.substr(place(), block);
      bytes.insert(place(), repeated);
    }
  }
  return bytes;
}

/// The digest made right for the bytes that are there.
inline std::string sealed(std::string bytes) {
  if (bytes.size() >= sealSize) seal(bytes);
  return bytes;
}

/// HDF5's checksum of metadata: Jenkins' lookup3, byte by byte.
inline std::uint32_t hdf5Checksum(const unsigned char* key, std::size_t length) {
  const auto turned = [](std::uint32_t x, int k) { return (x << k) | (x >> (32 - k)); };
  std::uint32_t a = 0xdeadbeefU + static_cast<std::uint32_t>(length), b = a, c = a;
  const auto add = [&](std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) (i < 4 ? a : i < 8 ? b : c) += std::uint32_t{key[i]} << (8 * (i % 4));
  };
  for (; length > 12; length -= 12, key += 12) {
    add(12);
    a = (a - c) ^ turned(c, 4), c += b;
    b = (b - a) ^ turned(a, 6), a += c;
    c = (c - b) ^ turned(b, 8), b += a;
    a = (a - c) ^ turned(c, 16), c += b;
    b = (b - a) ^ turned(a, 19), a += c;
    c = (c - b) ^ turned(b, 4), b += a;
  }
  if (length == 0) return c;
  add(length);
  c = (c ^ b) - turned(b, 14);
  a = (a ^ c) - turned(c, 11);
  b = (b ^ a) - turned(a, 25);
  c = (c ^ b) - turned(b, 16);
  a = (a ^ c) - turned(c, 4);
  b = (b ^ a) - turned(a, 14);
  return (c ^ b) - turned(b, 24);
}

/// The checksums of HDF5's superblock and of its object headers made right, so that the library believes them.
inline std::string withHdf5Checksums(std::string bytes) {
  auto* data = reinterpret_cast<unsigned char*>(bytes.data());
  const auto repair = [&](std::size_t begin, std::size_t size) {
    if (size > bytes.size() || begin + size + 4 > bytes.size()) return false;
    const std::uint32_t sum = hdf5Checksum(data + begin, size);
    for (int i = 0; i < 4; ++i)
      data[begin + size + static_cast<std::size_t>(i)] = static_cast<unsigned char>(sum >> (8 * i));
    return true;
  };
  repair(sealSize, 44);
  for (std::size_t at = 0; (at = bytes.find("OHDR", at)) != std::string::npos && at + 40 < bytes.size(); at += 4) {
    const unsigned flags = data[at + 5];
    std::size_t size = 6 + ((flags & 0x20U) != 0 ? 16 : 0) + ((flags & 0x10U) != 0 ? 4 : 0), chunk = 0;
    const std::size_t bytesOfSize = std::size_t{1} << (flags & 3U);
    for (std::size_t i = 0; i < bytesOfSize; ++i) chunk |= std::size_t{data[at + size + i]} << (8 * i);
    if (chunk < bytes.size()) repair(at, size + bytesOfSize + chunk);
  }
  return bytes;
}

}  // namespace gamut
