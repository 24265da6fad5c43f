// The page about the canvas: scenes, the editor, links. What runs on the canvas is `motes.js`.
import init, { Viewer, builtIn, kindOf, withFile } from "./motes.js";

const at = (id) => document.getElementById(id);
/** The built-in scenes by their names: their texts, and the files that they name. */
let scenes = new Map();
let viewer;
/** What is open: a name, a text, files (names and texts) and values; the tab that is edited; whether it is as it was built in. */
let open = { name: "", text: "", files: new Map(), overrides: [], scale: undefined };
let tab = "";
let loads = Promise.resolve();

/** The first comment of a scene. */
const about = (text) => {
  const lines = [];
  for (const line of text.split("\n")) {
    if (!line.startsWith("#")) break;
    lines.push(line.replace(/^# ?/, ""));
  }
  return lines.join(" ");
};
const sentence = (text) => text.split(/(?<=[.:!?]) /)[0];
const pairs = (flat) => new Map(Array.from({ length: flat.length / 2 }, (_, i) => [flat[2 * i], flat[2 * i + 1]]));

/** Bytes as words of a link, and back. */
const packed = async (text) => {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join("")).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
};
const unpacked = async (words) => {
  try {
    return await inflated(words);
  } catch {
    throw new Error("its text is damaged, or not all of it was copied");
  }
};
const inflated = async (words) => {
  const bytes = Uint8Array.from(atob(words.replace(/-/g, "+").replace(/_/g, "/")), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw"))).text();
};

/** Says what is wrong, or what is to be remarked. */
const say = (text, remarks = false) => {
  at("faults").textContent = text;
  at("faults").hidden = !text;
  at("faults").classList.toggle("remarks", remarks);
};
const shown = (text, failed = false) => {
  if (at("status").textContent !== text) at("status").textContent = text;
  at("status").classList.toggle("failed", failed);
};
/** Says something for long enough to be read, before the state of the run is shown again. */
let until = 0;
const announce = (text, failed = false) => {
  shown(text, failed);
  until = Date.now() + 4000;
};

/** What was edited last, so that it is not lost with the page. */
const DRAFT = "motes.draft";
const keep = () => {
  open.own = true;
  try {
    localStorage.setItem(DRAFT, JSON.stringify({ name: open.name, text: open.text, files: Object.fromEntries(open.files) }));
    hang();
  } catch {
    // A browser may keep nothing.
  }
};
const draft = () => {
  try {
    return JSON.parse(localStorage.getItem(DRAFT));
  } catch {
    return null;
  }
};
const given = ({ name, text, files }) => ({ name: String(name), text: String(text), files: new Map(Object.entries(files ?? {})), own: true });
/** Keeps a scene in the present entry of the browser's history, if the browser can. */
const stay = (scene) => {
  try {
    history.replaceState(record(scene), "");
  } catch {
    // It is too long for this browser, which then finds the last draft.
  }
};
/** A scene as an entry of the browser's history keeps it, for the way back to it. */
const record = ({ name, text, files, overrides, scale, own }) => ({ scene: { name, text, files: Object.fromEntries(files), overrides, scale, own } });

/** Opens what a link names: `#scene=galaxy&scale=0.5&simulation.dt=0.01`, or `#text=…`. */
const follow = async () => {
  const link = new URLSearchParams(location.hash.slice(1));
  const next = { name: link.get("scene") ?? "galaxy", text: "", files: new Map(), overrides: [], scale: undefined };
  const paused = link.get("paused") === "1" || (!link.has("paused") && matchMedia("(prefers-reduced-motion: reduce)").matches);
  for (const [key, value] of link) {
    if (!["scene", "scale", "paused", "text", "draft"].includes(key)) next.overrides.push(`${key}=${value}`);
  }
  if (link.has("scale")) next.scale = Number(link.get("scale"));
  const kept = history.state?.scene;
  try {
    if (kept) {
      Object.assign(next, kept, { files: new Map(Object.entries(kept.files)) });
    } else if (link.has("text")) {
      Object.assign(next, given({ name: next.name, ...JSON.parse(await unpacked(link.get("text"))) }));
    } else if (link.has("draft")) {
      if (!draft()) throw new Error("nothing was edited in this browser");
      Object.assign(next, given(draft()));
      // What is edited later is another one.
      stay(next);
    } else if (scenes.has(next.name)) {
      const { text, files } = scenes.get(next.name);
      Object.assign(next, { text, files: new Map(files) });
    } else {
      throw new Error(`there is no scene \`${next.name}\`: choose one of those that “Scenes” shows`);
    }
    if (next.scale !== undefined && !(next.scale > 0)) throw new Error("scale is no number above zero");
  } catch (why) {
    return refuse(`This link cannot be opened: ${why.message}`);
  }
  await run(next, paused);
};
/** Runs a scene; if it has faults, what runs goes on. Whether it runs. */
const run = (next, paused = false) => {
  let runs = !viewer;
  loads = loads.then(async () => {
    const changed = open.name !== next.name;
    open = next;
    if (changed || !next.files.has(tab)) tab = "";
    edit();
    if (!viewer) return without();
    shown(`opening ${next.name} …`);
    // The words above are shown before the work begins.
    await new Promise((done) => setTimeout(done, 30));
    try {
      const asked = signature(open);
      const remarks = await viewer.load(next.name, next.text, [...next.files].flat(), next.overrides, next.scale, paused);
      running = asked;
      say(remarks.join("\n"), true);
      if (at("editor").hidden) at("canvas").focus({ preventScroll: true });
      runs = true;
      document.title = `motes: ${next.name}`;
      at("title").textContent = `${next.name}: ${sentence(about(next.text))}`;
    } catch (why) {
      refuse(why.message);
    }
  });
  return loads.then(() => runs);
};
/** What a scene is made of, and that of what runs. */
const signature = ({ name, text, files, overrides, scale }) => JSON.stringify([name, text, [...files], overrides, scale]);
let running = "";
/** Gives a scene a place of its own among those that were open: the way back leads to what ran before. */
const remember = async (next) => {
  const url = await address(next);
  const kept = history.state?.scene;
  if (url === location.href || (kept && JSON.stringify(kept) === JSON.stringify(record(next).scene))) return;
  try {
    history.pushState(record(next), "", url ?? `#scene=${encodeURIComponent(next.name)}`);
  } catch {
    announce("the browser keeps no text as long as this one: there is no way back to it", true);
  }
};
const refuse = (text) => {
  say(text);
  toggle(true);
  shown(`this scene has faults, which stand beside it${running && "; what ran before goes on"}`, true);
};

/** The editor. */
const toggle = (wanted) => {
  at("editor").hidden = !wanted;
  at("edit").setAttribute("aria-expanded", String(wanted));
};
const edit = () => {
  at("tabs").replaceChildren(...["", ...open.files.keys()].map((name) => {
    const button = document.createElement("button");
    Object.assign(button, { type: "button", textContent: name || `${open.name}.toml` });
    button.setAttribute("role", "tab");
    button.setAttribute("aria-selected", String(name === tab));
    button.onclick = () => { tab = name; edit(); };
    return button;
  }));
  at("text").value = tab ? open.files.get(tab) : open.text;
};
at("text").oninput = () => {
  if (tab) open.files.set(tab, at("text").value);
  else open.text = at("text").value;
  keep();
};
at("text").onkeydown = (event) => {
  if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) at("editor").requestSubmit();
};
at("editor").onsubmit = async (event) => {
  event.preventDefault();
  await remember(open);
  await run(open);
};
at("edit").onclick = () => toggle(at("editor").hidden);
at("law").onclick = () => {
  const name = prompt("The name of the file, as the scene names it:", "law.wgsl");
  if (name) { open.files.set(name, open.files.get(name) ?? ""); tab = name; keep(); edit(); }
};
const download = (name, parts, type) => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob(parts, { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
};
at("save").onclick = () => download(tab || `${open.name}.toml`, [at("text").value], "text/plain");

/** The link to a scene, if it is not too long for one. */
const address = async ({ name, text, files, overrides, scale, own }) => {
  const link = new URLSearchParams();
  link.set("scene", name);
  if (own) {
    const words = await packed(JSON.stringify({ text, files: Object.fromEntries(files) }));
    if (words.length > 8000) return undefined;
    link.set("text", words);
  }
  if (scale !== undefined) link.set("scale", String(scale));
  for (const value of overrides) {
    const [key, to] = value.split(/=(.*)/s, 2);
    // The last one holds, for all of its parts.
    [...link.keys()].filter((known) => known === key || known.startsWith(`${key}.`)).forEach((known) => link.delete(known));
    link.append(key, to);
  }
  return `${location.href.split("#")[0]}#${link}`;
};
at("link").onclick = async () => {
  if ([...held].some((name) => open.text.includes(name))) return announce("a link does not carry files of particles: save the scene, and keep them beside it", true);
  // What was changed by hand belongs to what runs, which may be another one than what is written.
  const changes = signature(open) === running ? await viewer?.changes() ?? [] : [];
  // They hold for the particles that there are, and begin with the values of a scale: a factor is taken of all values of a scene.
  const scale = changes.length ? undefined : open.scale;
  const url = await address({ ...open, scale, overrides: [...open.overrides, ...changes] });
  if (!url) return announce("this scene is too long for a link: save it as a file", true);
  history.replaceState(null, "", url);
  await navigator.clipboard?.writeText(url).then(() => announce("the link is on the clipboard"), () => announce("the link stands in the address"));
};

/** The gallery. */
at("scenes").onclick = () => at("gallery").showModal();
at("close").onclick = () => at("gallery").close();
const go = (hash) => {
  if (location.hash !== hash || history.state?.scene) history.pushState(null, "", hash);
  follow();
};
const card = (name, title, text, hash) => {
  const card = document.createElement("a");
  Object.assign(card, { className: "card", href: hash });
  const picture = document.createElement("img");
  Object.assign(picture, { alt: "", loading: "lazy", src: `pictures/${name}.png` });
  const words = document.createElement("span");
  words.textContent = sentence(about(text));
  card.append(picture, Object.assign(document.createElement("strong"), { textContent: title }), words);
  card.onclick = (event) => { event.preventDefault(); at("gallery").close(); go(hash); };
  return card;
};
const hang = () => {
  const last = draft();
  const mine = last ? [card(scenes.has(last.name) ? last.name : "galaxy", `${last.name}, as you edited it last`, last.text, "#draft=1")] : [];
  at("cards").replaceChildren(...mine, ...[...scenes].map(([name, { text }]) => card(name, name, text, `#scene=${name}`)));
};

/** Files of bytes that were dropped: their names. They are in no link. */
const held = new Set();
/** The longest text that is shown for editing, and goes into links and the draft. */
const LONGEST = 100_000;
/** A file as text, if it is one. */
const words = (bytes) => {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return undefined;
  }
};
/** A scene with a file beside it: particles and a floor plan take the place of its own, and a law is one more force, unless the scene names the file. */
const beside = async (next, file) => {
  const bytes = new Uint8Array(await file.arrayBuffer());
  const [kind, text] = [kindOf(file.name), words(bytes)];
  const whole = withFile(next.text, file.name, text ?? "");
  const named = whole === next.text;
  const files = new Map(next.files);
  files.delete(file.name);
  if (text !== undefined && kind !== "particles" && text.length < LONGEST) {
    files.set(file.name, text);
  } else {
    await viewer?.hold(file.name, bytes);
    held.add(file.name);
  }
  // Sizes and values of the particles from before are none of others.
  const others = kind === "particles" && !named ? { scale: undefined, overrides: next.overrides.filter((value) => !value.startsWith("particles.")) } : {};
  return { ...next, ...others, text: whole, files };
};
/** Files that are dropped. What cannot be used is said, and the rest is run. */
document.addEventListener("dragover", (event) => event.preventDefault());
let drops = Promise.resolve();
document.addEventListener("drop", (event) => {
  event.preventDefault();
  const all = [...(event.dataTransfer?.files ?? [])];
  // One after the other: each is beside what the one before has made.
  drops = drops.then(() => dropped(all));
});
const dropped = async (all) => {
  const [scenes, others] = [true, false].map((wanted) => all.filter((file) => /\.toml$/i.test(file.name) === wanted));
  const paused = (await viewer?.status())?.paused ?? false;
  let next = open;
  for (const file of scenes) {
    next = { ...next, name: file.name.replace(/\.toml$/i, "") || "scene", text: await file.text(), overrides: [], scale: undefined, own: true };
  }
  const faults = [];
  for (const file of others) {
    try {
      next = { ...await beside(next, file), own: true };
    } catch (why) {
      faults.push(why.message);
    }
  }
  toggle(true);
  const before = open;
  if (next !== open) {
    if (await run(next, paused && !scenes.length)) {
      await remember(next);
      keep();
    } else {
      // What was written before is not lost by a file that is no good.
      open = before;
      edit();
    }
  }
  if (faults.length && (at("faults").hidden || at("faults").classList.contains("remarks"))) say(faults.join("\n"), true);
};

/** The keys of the browser stay its own: reload, find, address, full screen; Shift + Tab leads out of the canvas, in which Tab goes from one control to the next. */
document.addEventListener("keydown", (event) => {
  if (event.target === at("canvas") && (event.ctrlKey || event.metaKey || event.altKey || /^F\d+$/.test(event.key)
    || (event.key === "Tab" && event.shiftKey))) event.stopPropagation();
}, true);
/** A fault of the program itself, such as a lack of memory. */
const broken = (event) => {
  const why = event.reason?.message ?? event.reason ?? event.message;
  shown(`the program failed: ${why}. Load the page again; a scene with fewer particles needs less memory.`, true);
};
window.addEventListener("error", broken);
window.addEventListener("unhandledrejection", broken);

/** What is shown where nothing can run. */
const without = () => {
  const { name, text } = open;
  const words = document.createElement("p");
  words.textContent = about(text);
  const picture = Object.assign(document.createElement("img"), { src: `pictures/${name}.png`, alt: `A picture of ${name}` });
  picture.onerror = () => picture.remove();
  const why = document.createElement("p");
  why.textContent = at("instead").dataset.why;
  at("instead").replaceChildren(why, words, picture);
  at("instead").hidden = false;
  shown("nothing runs here", true);
};
const NONE = "This browser offers no WebGPU, so nothing can be simulated here. Chrome and Edge have it since version 113, Safari since 26, "
  + "Firefox since 141; a page needs https, or to be served by this machine. The command `motes` runs the same scenes without a browser.";

/** How the run stands, four times a second. */
const watch = async () => {
  try {
    const status = await viewer.status();
    if (status.failed) {
      shown(`stopped: ${status.failed}. Load the page again to go on.`, true);
    } else if (status.scene && Date.now() > until && at("faults").hidden | at("faults").classList.contains("remarks")) {
      shown(`${status.scene} · step ${status.steps}${status.message ? ` · ${status.message}` : ""}`);
    }
    if (status.picture) download(status.picture, [status.png], "image/png");
    if (status.asked) go(`#scene=${status.asked}`);
    status.free();
  } catch (why) {
    shown(`stopped: ${why.message}`, true);
    return;
  }
  setTimeout(watch, 250);
};

const start = async () => {
  await init({ module_or_path: new URL("motes_bg.wasm", import.meta.url) });
  scenes = new Map(builtIn().map((scene) => [scene.name, { text: scene.text, files: pairs(scene.files) }]));
  hang();
  if (!navigator.gpu) {
    at("instead").dataset.why = NONE;
  } else {
    try {
      viewer = await Viewer.open(at("canvas"));
      watch();
    } catch (why) {
      at("instead").dataset.why = `${why.message}. The command \`motes\` runs the same scenes without a browser.`;
    }
  }
  // What tests call.
  window.motes = viewer;
  window.addEventListener("popstate", follow);
  // When the page is loaded again, what was edited last is there.
  if (location.hash === "#draft=1") history.replaceState(null, "");
  await follow();
};
start().catch((why) => shown(`the page cannot start: ${why.message}`, true));
