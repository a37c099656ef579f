# clca and its Python package, from the Debian packages in build/package (docs/install.md):
#   docker build -t clca . && docker run --rm -v "$PWD:/work" clca run wall-removal
FROM debian:12-slim
COPY build/package/*.deb /tmp/packages/
RUN apt-get update \
 && apt-get install -y /tmp/packages/clca_*.deb /tmp/packages/python3-clca_*.deb \
 && rm -rf /var/lib/apt/lists/* /tmp/packages
WORKDIR /work
ENTRYPOINT ["clca"]
