# dspm in a container: docker build -t dspm . && docker run --rm -v "$PWD:/scenes" dspm ball.dsc --png
ARG DEBIAN=12

FROM debian:${DEBIAN} AS build
COPY . /dspm
RUN /dspm/dev package deb

FROM debian:${DEBIAN}-slim
COPY --from=build /dspm/out/dspm_*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/dspm_*.deb ffmpeg \
    && rm -rf /tmp/dspm_*.deb /var/lib/apt/lists/*
WORKDIR /scenes
ENTRYPOINT ["dspm"]
