// Opens the built page in Chromium, with WebGPU by SwiftShader, and checks what it does. Arguments: the folder of the page, the command
// `motes`, which runs the same scenes, and a folder for pictures.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { chromium } from "playwright-core";
import { open, serve } from "./serve.mjs";

const [folder, motes, pictures] = process.argv.slice(2);
const LIMIT = 120_000;
/** Scenes small enough for a processor, and the part of the larger energy by which theirs may differ after 100 steps from the command's: both
 * are single precision, on two drivers. */
const SCENES = [
  ["galaxy", 0.02, 1e-6],
  ["cloth", 0.2, 1e-6],
  ["dam_break", 0.1, 1e-6],
  ["fish_school", 0.1, 1e-6],
];

const server = await serve(folder);
const browser = await open(chromium);
const said = [];

/** A page that shows a link, once the scene runs. */
const visit = async (link, before) => {
  const page = await browser.newPage({ viewport: { width: 900, height: 600 } });
  page.setDefaultTimeout(LIMIT);
  page.on("console", (message) => { if (["error", "warning"].includes(message.type())) said.push(`${link}: ${message.text()}`); });
  page.on("pageerror", (error) => said.push(`${link}: ${error.message}`));
  if (before) await page.addInitScript(before);
  const begun = Date.now();
  await page.goto(`${server.url}#${link}`);
  return Object.assign(page, { begun });
};
/** Waits until a question to the page is answered by something true. */
const until = async (page, question, value) => {
  const end = Date.now() + LIMIT;
  while (Date.now() < end) {
    const answer = await page.evaluate(question, value);
    if (answer) return answer;
    await page.waitForTimeout(200);
  }
  throw new Error(`after ${LIMIT / 1000} s still not: ${question}; the page says: ${await page.textContent("#status")}; ${await page.textContent("#faults")}`);
};
const runs = (page, scene) => until(page, async (scene) => {
  const status = await window.motes?.status();
  if (status?.failed) throw new Error(status.failed);
  return status?.scene === scene;
}, scene);
/** Copies the link, and waits for what is said of it. */
const copied = async (page, words) => {
  await page.click("#link");
  await until(page, (words) => document.getElementById("status").textContent.includes(words), words);
};
const steps = (page) => page.evaluate(async () => (await window.motes.status()).steps);

/** How many pixels of the canvas are brighter than a dark grey, and their means: it is drawn again, and read by the page itself. */
const lit = async (page, name) => {
  const png = await page.locator("#canvas").screenshot();
  if (pictures) writeFileSync(join(pictures, `${name}.png`), png);
  return page.evaluate(async (words) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${words}`)).blob());
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    // The panel lies on the right.
    const { data } = context.getImageData(0, 0, Math.floor(0.6 * image.width), image.height);
    let count = 0;
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      const bright = Math.max(data[i], data[i + 1], data[i + 2]);
      sum += bright;
      if (bright > 60) count += 1;
    }
    return { count, sum };
  }, png.toString("base64"));
};

/** The first and the last row of the command's energies in a hundred steps: kinetic, potential. */
const command = (scene, scale) => {
  const place = mkdtempSync(join(tmpdir(), "page-"));
  execFileSync(motes, ["run", scene, "--scale", String(scale), "--steps", "100", "-o", place, "--quiet"], { stdio: "pipe" });
  const [head, ...rows] = readFileSync(join(place, "energy.csv"), "utf8").trim().split("\n").map((row) => row.split(","));
  const column = (row, name) => Number(row[head.indexOf(name)]);
  return [rows[0], rows.at(-1)].map((row) => ["kinetic", "potential"].map((name) => column(row, name)));
};

const tests = {
  async "a scene is shown, and runs"() {
    const page = await visit("scene=galaxy&scale=0.02");
    await runs(page, "galaxy");
    const seconds = (Date.now() - page.begun) / 1000;
    assert.ok(seconds < 30, `it opened after ${seconds} s`);
    const before = await steps(page);
    await until(page, async (before) => (await window.motes.status()).steps > before + 5, before);
    const { count } = await lit(page, "galaxy");
    assert.ok(count > 500, `${count} pixels of the picture are lit`);
    assert.match(await page.textContent("#status"), /galaxy · step \d+/);
    await page.close();
  },
  async "energies are those of the command"() {
    for (const [scene, scale, part] of SCENES) {
      const page = await visit(`scene=${scene}&scale=${scale}&paused=1`);
      await runs(page, scene);
      assert.equal(await steps(page), 0, "a link with `paused` stands still");
      const [, ...here] = await page.evaluate(async () => [...await window.motes.advance(100)]);
      const [first, there] = command(scene, scale);
      const larger = Math.max(...there.map(Math.abs));
      const between = (one) => Math.max(...one.map((value, i) => Math.abs(value - there[i]))) / larger;
      const apart = between(here);
      console.log(`  ${scene}: kinetic and potential energy ${here} in the page, ${there} by the command, ${apart.toExponential(1)} apart`);
      assert.ok(apart < part, `${scene}: ${here} in the page, ${there} by the command`);
      assert.ok(between(first) > 100 * part, `${scene}: a hundred steps change its energies`);
      await page.waitForTimeout(1000);
      const { count } = await lit(page, scene);
      assert.ok(count > 300, `${scene}: ${count} pixels of the picture are lit`);
      await page.close();
    }
  },
  async "values of a link, and faults of a scene"() {
    const page = await visit("scene=galaxy&scale=0.02&paused=1&picture.style=glow");
    await runs(page, "galaxy");
    await page.evaluate(() => { location.hash = "#scene=galaxy&scale=0.02&force.0.softning=1"; });
    await page.waitForSelector("#faults:not([hidden])");
    const fault = await page.textContent("#faults");
    assert.match(fault, /softning[\s\S]*softening/, fault);
    await page.click("#edit");
    await page.click("#edit");
    await page.fill("#text", "# A scene\n[simulation]\ndt = \"short\"\nsteps = 10\n");
    await page.click("#editor [type=submit]");
    await until(page, () => document.getElementById("faults").textContent.includes("short"));
    assert.match(await page.textContent("#faults"), /\^/, "a caret stands at the place");
    const status = await page.evaluate(async () => (await window.motes.status()).scene);
    assert.equal(status, "galaxy", "what ran before goes on");
    await page.close();
  },
  async "a law of one's own, in a file of its own, by a link"() {
    const page = await visit("scene=galaxy&scale=0.02&paused=1");
    await runs(page, "galaxy");
    const law = "struct Params { strength: f32 }\n@group(3) @binding(0) var<uniform> params: Params;\n"
      + "fn force(me: Particle) -> vec4f {\n    return vec4f(-params.strength * me.position, 0.5 * params.strength * dot(me.position, me.position));\n}\n";
    const scene = "# Particles on springs to the origin.\n[simulation]\ndt = 0.01\nsteps = 1000\n\n[[particles]]\nshape = \"sphere\"\ncount = 500\nradius = 1.0\n\n"
      + "[[force]]\nwgsl = \"law.wgsl\"\nover = \"each\"\nparams = { strength = 1.0 }\n";
    await page.evaluate(() => { window.prompt = () => "law.wgsl"; document.getElementById("law").click(); });
    await page.evaluate(({ law, scene }) => {
      const text = document.getElementById("text");
      const type = (words) => { text.value = words; text.dispatchEvent(new Event("input")); };
      type(law);
      document.querySelector("#tabs button").click();
      type(scene);
      document.getElementById("editor").requestSubmit();
    }, { law, scene });
    await until(page, async () => (await window.motes.advance(0), document.getElementById("faults").textContent === ""
      && document.getElementById("title").textContent.includes("springs")));
    // From rest at x₀ each is at x₀ cos t, so that their kinetic energy is tan² t of their potential one; by steps of 0.01 to 1e-4.
    const [time, kinetic, potential] = await page.evaluate(async () => [...await window.motes.advance(50)]);
    const ratio = kinetic / potential / Math.tan(time) ** 2;
    assert.ok(time >= 0.5 && Math.abs(ratio - 1) < 1e-3, `${time} ${kinetic} ${potential} ${ratio}`);
    await copied(page, "the link");
    const link = await page.evaluate(() => location.hash);
    const other = await visit(link.slice(1));
    await until(other, () => document.getElementById("title").textContent.includes("springs"));
    assert.equal(await other.textContent("#faults"), "");
    await page.close();
    await other.close();
  },
  async "files that are dropped become parts of the scene"() {
    const page = await visit("scene=plummer&scale=0.01&paused=1");
    await runs(page, "plummer");
    const drop = (name, text) => page.evaluate((files) => {
      const dataTransfer = new DataTransfer();
      files.forEach(([name, text]) => dataTransfer.items.add(new File([text], name)));
      document.dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
    }, Array.isArray(name) ? name : [[name, text]]);
    // Two bodies in place of the sphere, with their own kinetic energy: 2 × ½ m v².
    await drop("two.csv", "x,y,z,vx,vy,vz,mass\n-1,0,0,0,0.5,0,3\n1,0,0,0,-0.5,0,3\n");
    await until(page, () => document.getElementById("text").value.includes("two.csv"));
    const energies = () => page.evaluate(async () => [...await window.motes.advance(0)]);
    await until(page, async () => Math.abs((await window.motes.advance(0))[1] - 0.75) < 1e-6);
    assert.equal(await page.textContent("#faults"), "");
    assert.match(await page.inputValue("#text"), /^# /, "the comment stays");
    // A spring to the origin of each: ½ m x² = 3 more.
    const [, , before] = await energies();
    await drop("hold.wgsl", "fn force(me: Particle) -> vec4f { return vec4f(-me.position, 0.5 * dot(me.position, me.position)); }\n");
    await until(page, () => document.getElementById("text").value.includes("hold.wgsl"));
    await until(page, async (before) => Math.abs((await window.motes.advance(0))[2] - before - 3) < 1e-4, before);
    assert.ok(await page.evaluate(async () => (await window.motes.status()).paused), "what stood still stands still");
    // What cannot be used is said, and nothing changes.
    const before_text = await page.inputValue("#text");
    for (const [name, text, why] of [["letter.docx", "Dear all", /letter\.docx[\s\S]*\.csv/], ["house.svg", "<svg/>", /house\.svg[\s\S]*\[plan\]/]]) {
      await drop(name, text);
      await until(page, (name) => document.getElementById("faults").textContent.includes(name), name);
      assert.match(await page.textContent("#faults"), why);
      assert.equal(await page.inputValue("#text"), before_text);
      assert.ok(!(await page.textContent("#tabs")).includes(name), `${name} is kept`);
    }
    await copied(page, "does not carry");
    // A scene with its files is run as it is; the way back leads to what ran before.
    await drop([["Four.TOML", "# Four stones.\n[simulation]\ndt = 0.01\nsteps = 10\n[[particles]]\nshape = \"sphere\"\ncount = 4\n[[force]]\nwgsl = \"hold.wgsl\"\nover = \"each\"\n"],
      ["hold.wgsl", "fn force(me: Particle) -> vec4f { return vec4f(0.0); }\n"]]);
    await until(page, () => document.getElementById("title").textContent === "Four: Four stones.");
    assert.equal((await page.inputValue("#text")).match(/hold\.wgsl/g).length, 1);
    assert.equal(await page.textContent("#faults"), "");
    await page.goBack();
    await until(page, () => document.getElementById("title").textContent.startsWith("plummer"));
    // A floor plan takes the place of that of a room.
    await page.evaluate(() => { location.hash = "#scene=room&paused=1"; });
    await runs(page, "room");
    await drop("square.wkt", "GEOMETRYCOLLECTION (POLYGON ((0 0, 15 0, 15 15, 0 15, 0 0)), LINESTRING (14.7 6, 14.7 9))");
    await until(page, () => document.getElementById("text").value.includes("square.wkt"));
    assert.match(await page.textContent("#tabs"), /square\.wkt/);
    await page.close();
  },
  async "the gallery has a picture of every scene, and opens them"() {
    const page = await visit("scene=galaxy&scale=0.02&paused=1");
    await runs(page, "galaxy");
    await page.click("#scenes");
    const cards = await until(page, async () => {
      const cards = [...document.querySelectorAll(".card")];
      cards.forEach((card) => { const img = card.querySelector("img"); if (img) img.loading = "eager"; });
      const drawn = cards.filter((card) => card.querySelector("img")?.naturalWidth > 100);
      return cards.length > 10 && drawn.length === cards.length && cards.length;
    });
    console.log(`  ${cards} scenes`);
    await page.click('.card[href="#scene=figure_eight"]');
    await runs(page, "figure_eight");
    assert.match(await page.textContent("#title"), /^figure_eight: /);
    await page.close();
  },
  async "what was edited is not lost: by the way back, by the gallery, and when the page is loaded again"() {
    const page = await visit("scene=galaxy&scale=0.02&paused=1");
    await runs(page, "galaxy");
    const title = (words) => until(page, (words) => document.getElementById("title").textContent === words, words);
    /** Runs a text, opens another scene, and goes back to the text. */
    const and_back = async (text, words) => {
      await page.fill("#text", text);
      await page.press("#text", "Control+Enter");
      await title(words);
      await page.evaluate(() => { location.hash = "#scene=throw&paused=1"; });
      await runs(page, "throw");
      await page.goBack();
      await title(words);
      assert.equal(await page.inputValue("#text"), text);
    };
    await page.click("#edit");
    const edited = "# Four stones.\n[simulation]\ndt = 0.01\nsteps = 10\n[[particles]]\nshape = \"sphere\"\ncount = 4\n";
    await page.evaluate(() => { location.hash = "#scene=kepler&paused=1"; });
    await runs(page, "kepler");
    await and_back(edited, "kepler: Four stones.");
    await page.goBack();
    await until(page, () => document.getElementById("title").textContent.startsWith("kepler: Two bodies"));
    // Text that was never run, in a new visit.
    await page.fill("#text", edited.replace("Four", "Five"));
    await page.reload();
    await runs(page, "kepler");
    await page.click("#scenes");
    assert.match(await page.textContent(".card"), /kepler, as you edited it last\s*Five stones/);
    await page.click(".card");
    await title("kepler: Five stones.");
    // The way back leads to this one, whatever is edited later; also to a text that is too long for a link.
    const noise = Array.from({ length: 4000 }, (_, i) => Math.imul(i, 2654435761) >>> 0).join(" ");
    const long = `${edited.replace("Four", "Six")}# ${noise}\n`;
    await page.click("#edit");
    await and_back(long, "kepler: Six stones.");
    await copied(page, "too long for a link");
    await page.goBack();
    await title("kepler: Five stones.");
    await page.close();
  },
  async "a link carries what was changed by hand"() {
    const page = await visit("scene=galaxy&scale=0.02&paused=1");
    await runs(page, "galaxy");
    await page.waitForTimeout(1000);
    assert.deepEqual(await page.evaluate(() => window.motes.changes()), []);
    const before = await lit(page, "straight");
    await page.mouse.move(200, 300);
    await page.mouse.down();
    await page.mouse.move(210, 440, { steps: 4 });
    await page.mouse.up();
    await until(page, async () => (await window.motes.changes()).length > 0);
    const changes = await page.evaluate(() => window.motes.changes());
    assert.ok(changes.some((value) => value.startsWith("picture.eye=[")), `${changes}`);
    await copied(page, "the link");
    const link = await page.evaluate(() => location.hash);
    assert.match(link, /picture\.extent=/);
    const other = await visit(`${link.slice(1)}&paused=1`);
    await runs(other, "galaxy");
    assert.equal(await other.textContent("#faults"), "");
    await other.waitForTimeout(1000);
    const [one, two] = [await lit(page, "turned"), await lit(other, "linked")];
    assert.ok(Math.abs(one.sum - two.sum) < 0.02 * one.sum, `the same view: ${one.sum} and ${two.sum}`);
    assert.ok(Math.abs(one.sum - before.sum) > 0.03 * one.sum, `another view than before: ${one.sum} and ${before.sum}`);
    await page.close();
    await other.close();
  },
  async "links that are damaged are refused in words"() {
    const page = await visit("text=abc&paused=1");
    await page.waitForSelector("#faults:not([hidden])");
    assert.match(await page.textContent("#faults"), /not all of it was copied/);
    assert.ok(!(await page.textContent("#status")).includes("goes on"), "nothing ran before");
    await page.close();
  },
  async "the program is small"() {
    const files = readdirSync(folder).filter((name) => /\.(wasm|js|css|html)$/.test(name));
    const bytes = files.reduce((sum, name) => sum + gzipSync(readFileSync(join(folder, name)), { level: 9 }).length, 0);
    console.log(`  ${(bytes / 1e6).toFixed(2)} MB by gzip`);
    assert.ok(files.length >= 5 && bytes < 5e6, `${files}: ${bytes} bytes`);
  },
  async "keys are those of the viewer, and of the browser"() {
    const page = await visit("scene=galaxy&scale=0.02");
    await runs(page, "galaxy");
    await page.waitForTimeout(1000);
    assert.equal(await page.evaluate(() => document.activeElement.id), "canvas");
    await page.keyboard.press("Space");
    await page.waitForTimeout(1500);
    const still = await steps(page);
    await page.waitForTimeout(1000);
    assert.equal(await steps(page), still, "Space stops the run");
    await page.keyboard.press(".");
    await until(page, async (still) => (await window.motes.status()).steps === still + 1, still);
    const taken = await page.evaluate(() => {
      let taken = 0;
      const press = (key, more) => document.getElementById("canvas").dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true, ...more }));
      // An event whose default is prevented is taken from the browser.
      for (const [key, more] of [["r", { ctrlKey: true }], ["F5", {}], ["l", { ctrlKey: true }]]) taken += press(key, more) ? 0 : 1;
      return taken;
    });
    assert.equal(taken, 0, "the browser keeps its keys");
    await page.keyboard.press("Tab");
    assert.equal(await page.evaluate(() => document.activeElement.id), "canvas", "Tab goes through the panel");
    await page.keyboard.press("Shift+Tab");
    assert.equal(await page.evaluate(() => document.activeElement.id), "link", "Shift + Tab leaves it");
    await page.close();
  },
  async "laws that do not compile are said"() {
    const page = await visit("scene=galaxy&scale=0.02&paused=1");
    await runs(page, "galaxy");
    // A law that naga refuses: its place is shown, and the scene from before goes on.
    await page.evaluate(() => {
      const text = document.getElementById("text");
      const type = (words) => { text.value = words; text.dispatchEvent(new Event("input")); };
      window.prompt = () => "law.wgsl";
      document.getElementById("law").click();
      type("fn force(me: Particle) -> vec4f {\n    return mee.position;\n}\n");
      document.querySelector("#tabs button").click();
      type(`${text.value}\n[[force]]\nwgsl = "law.wgsl"\nover = "each"\n`);
      document.getElementById("editor").requestSubmit();
    });
    await page.waitForSelector("#faults:not([hidden])");
    assert.match(await page.textContent("#faults"), /law\.wgsl:2[\s\S]*mee/, await page.textContent("#faults"));
    assert.equal(await page.evaluate(async () => (await window.motes.status()).scene), "galaxy");
    await page.close();
  },
  async "without WebGPU it says so, and shows a picture"() {
    const page = await visit("scene=galaxy", () => Object.defineProperty(Navigator.prototype, "gpu", { get: () => undefined }));
    await page.waitForSelector("#instead:not([hidden])");
    assert.match(await page.textContent("#instead"), /WebGPU/);
    assert.ok(await page.evaluate(() => document.querySelectorAll(".card").length) > 10, "the gallery is there");
    await page.close();
  },
};

let failed = 0;
const wanted = process.env.PAGE_TEST;
for (const [name, test] of Object.entries(tests)) {
  if (wanted && !name.includes(wanted)) continue;
  const begun = Date.now();
  try {
    await test();
    assert.deepEqual(said, [], "the console is silent");
    console.log(`ok   ${name} (${((Date.now() - begun) / 1000).toFixed(1)} s)`);
  } catch (why) {
    failed += 1;
    console.log(`FAIL ${name}: ${why.stack}\n  console: ${said.join("\n  ")}`);
  }
  said.length = 0;
}
await browser.close();
server.end();
process.exit(failed ? 1 : 0);
