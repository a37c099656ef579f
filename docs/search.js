// A page that is opened as a file may neither fetch the index of the search nor start a worker: the index is a script
// then, and the worker runs in a frame.
if (location.protocol === "file:") {
  const folder = new URL(".", document.currentScript.src);
  document.write(`<script src="${new URL("search/search_index.js", folder)}"><\/script>`);

  window.Worker = class extends EventTarget {
    constructor(source) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      document.body.append(frame);
      this.inside = frame.contentWindow;
      this.inside.postMessage = (data) => this.dispatchEvent(new MessageEvent("message", {data}));
      const script = frame.contentDocument.createElement("script");
      this.ready = new Promise((resolve) => script.addEventListener("load", resolve));
      script.src = source;
      frame.contentDocument.body.append(script);
    }

    postMessage(data) {
      this.ready.then(() => this.inside.dispatchEvent(new MessageEvent("message", {data})));
    }
  };
}
