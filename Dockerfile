# SPDX-License-Identifier: MIT
# The banyan program with every feature that Debian 13 has libraries for. No step of ./check builds this image.
#   docker build --tag banyan .
#   docker run --rm --user "$(id -u):$(id -g)" --volume "$PWD:/work" banyan run /usr/local/share/banyan/scenarios/three-targets.toml
FROM debian:13-slim AS build
RUN apt-get update && apt-get install --yes --no-install-recommends \
    g++ cmake ninja-build pkgconf git ca-certificates \
    libzstd-dev libbox2d-dev libyaml-dev librsvg2-dev libsodium-dev libpagmo-dev libtbb-dev libboost-serialization-dev libopenmpi-dev \
    && rm -rf /var/lib/apt/lists/*
WORKDIR /banyan
COPY . .
# The header-only libraries are those of third_party/, with which Banyan is tested.
RUN cmake --preset release -DBANYAN_THIRD_PARTY=ON && cmake --build --preset release \
    && cmake --install build/release --component program --prefix /opt/banyan --strip \
    && mkdir -p /opt/needed \
    && for file in /opt/banyan/bin/*; do ldd "$file" || true; done | sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p' | sort -u \
       | xargs -r -n1 realpath | xargs -r dpkg-query --search 2>/dev/null | sed 's/:.*//' | sort -u > /opt/needed/packages

FROM debian:13-slim
COPY --from=build /opt/needed/packages /tmp/packages
# The libraries that the programs are linked with, and what they load or start: pixels, films, figures, text in pictures.
RUN apt-get update && apt-get install --yes --no-install-recommends $(cat /tmp/packages) \
    librsvg2-2 ffmpeg python3-matplotlib fonts-dejavu-core openmpi-bin \
    && rm -rf /var/lib/apt/lists/* /tmp/packages
COPY --from=build /opt/banyan /usr/local
WORKDIR /work
ENTRYPOINT ["banyan"]
CMD ["--help"]
