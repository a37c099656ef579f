'use strict';

// Steps through the pictures of the run.
(function () {
  const frames = [...document.querySelectorAll('#frames data')].map(function (frame) { return frame.dataset; });
  if (frames.length === 0) return;
  const [player, picture, slider, label, button] =
    ['player', 'frame', 'slider', 'frame-label', 'play'].map(function (id) { return document.getElementById(id); });
  const pause = 90;  // milliseconds from one picture to the next
  let at = 0;
  let timer = null;

  function show(number) {
    at = Math.max(0, Math.min(frames.length - 1, number));
    const frame = frames[at];
    picture.src = frame.same ? document.getElementById(frame.same).src : frame.image;
    picture.alt = 'Picture of the particles. ' + frame.words;
    slider.value = at;
    slider.setAttribute('aria-valuetext', frame.words);
    label.textContent = frame.words + ' (' + (at + 1) + ' of ' + frames.length + ')';
  }

  function stop() {
    clearInterval(timer);
    timer = null;
    button.textContent = 'Play';
  }

  function play() {
    if (timer) return stop();
    if (at === frames.length - 1) show(0);
    button.textContent = 'Pause';
    timer = setInterval(function () {
      show(at + 1);
      if (at === frames.length - 1) stop();
    }, pause);
  }

  // #step=120 shows the first picture from there on.
  function go() {
    const wanted = /^#step=(\d+)$/.exec(location.hash);
    if (!wanted) return false;
    const found = frames.findIndex(function (frame) { return Number(frame.step) >= Number(wanted[1]); });
    show(found < 0 ? frames.length - 1 : found);
    return true;
  }

  slider.max = frames.length - 1;
  slider.addEventListener('input', function () {
    stop();
    show(Number(slider.value));
  });
  button.addEventListener('click', play);
  document.addEventListener('keydown', function (event) {
    if (event.altKey || event.ctrlKey || event.metaKey || event.target === slider) return;
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step && !event.target.closest('.wide, pre')) {
      stop();
      show(at + step);
      event.preventDefault();
    } else if (event.key === ' ' && event.target === document.body) {
      play();
      event.preventDefault();
    }
  });
  window.addEventListener('hashchange', go);
  player.hidden = false;
  if (!go()) show(frames.length - 1);
})();

// What is folded is printed, too.
window.addEventListener('beforeprint', function () {
  document.querySelectorAll('details').forEach(function (details) { details.open = true; });
});
