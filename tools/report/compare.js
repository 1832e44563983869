"use strict";
// Overlays two images of one group. The slider, or the pointer on the image, moves the divider.
for (const box of document.querySelectorAll("[data-images]")) {
  const data = JSON.parse(box.querySelector('script[type="application/json"]').textContent);
  const stack = box.querySelector(".stack"), split = box.querySelector("[data-split]");

  for (const select of box.querySelectorAll("[data-side]")) {
    const image = box.querySelector(`[data-show="${select.dataset.side}"]`);
    const show = () => {
      image.src = data.images[select.value];
      image.alt = `${select.options[select.selectedIndex].text}: image on the ${select.dataset.side}`;
    };
    select.addEventListener("change", show);
    // Decode the images of a scene when it comes near the window.
    new IntersectionObserver((entries, observer) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      observer.disconnect();
      show();
    }, { rootMargin: "800px" }).observe(stack);
  }

  const place = (percent) => {
    split.value = percent;
    stack.style.setProperty("--split", `${split.value}%`);
  };
  split.addEventListener("input", () => place(split.value));
  const follow = (event) => {
    const frame = stack.getBoundingClientRect();
    place((100 * (event.clientX - frame.left)) / frame.width);
  };
  stack.addEventListener("pointerdown", (event) => {
    stack.setPointerCapture(event.pointerId);
    follow(event);
  });
  stack.addEventListener("pointermove", (event) => {
    if (stack.hasPointerCapture(event.pointerId)) follow(event);
  });
  // Flip: alternate between the two complete images.
  box.querySelector("[data-flip]").addEventListener("click", () => place(Number(split.value) < 50 ? 100 : 0));

  // Show the differences of one renderer.
  const renderer = box.querySelector("[data-renderer]");
  renderer?.addEventListener("change", () => {
    for (const grid of box.querySelectorAll("[data-of]")) grid.hidden = grid.dataset.of !== renderer.value;
  });
}
