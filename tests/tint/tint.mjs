// Compiles every shader of a folder's lists with Tint, the WGSL compiler of Chrome, and makes a pipeline of each with its constants, on
// a device of WebGPU's default limits that runs nothing. The lists are what the tests `engine` and `mutants` write where
// MOTES_SHADERS is a folder: { of, files, code, entry, constants, lanes }. Every file below shaders/ must be in one of them.
//
// node tint.mjs FOLDER SHADERS
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { create, globals } from 'webgpu';

Object.assign(globalThis, globals);
const [folder, root] = process.argv.slice(2);
const lists = readdirSync(folder).filter((name) => name.endsWith('.json'));
const shaders = lists.flatMap((name) => JSON.parse(readFileSync(join(folder, name), 'utf8')));
const gpu = create(['backend=null']);
const device = async (requiredFeatures) => (await gpu.requestAdapter()).requestDevice({ requiredFeatures });
const [bare, wide] = [await device([]), await device(['subgroups'])];

const faults = new Map();
const modules = new Map();
let leftOut = 0;
for (const { of, code, entry, constants, lanes } of shaders) {
  // Where a machine has no subgroups nothing may ask for them.
  const asks = lanes > 0 && /@builtin\(subgroup_|\bsubgroup[A-Z]\w*\(/.test(code);
  const device = asks ? wide : bare;
  const eight = asks && lanes === 8;
  const key = `${asks} ${eight} ${code}`;
  if (!modules.has(key)) {
    device.pushErrorScope('validation');
    // naga knows no such directive, and needs none.
    const module = device.createShaderModule({ code: asks ? `enable subgroups;${code}` : code });
    const { messages } = await module.getCompilationInfo();
    const refused = await device.popErrorScope();
    // Variants for subgroups of eight lanes run on software adapters alone, through naga. Tint does not see that what is shuffled by one
    // lane number is the same in all lanes, nor that a workgroup of eight lanes is one subgroup.
    const uniform = (message) => eight && /must only be called from (subgroup )?uniform control flow/.test(message.message);
    const errors = messages.filter((message) => message.type === 'error' && !uniform(message));
    if (messages.some(uniform)) leftOut += 1;
    modules.set(key, messages.some((message) => message.type === 'error') || refused ? undefined : module);
    const line = (message) => `${message.message} in \`${code.split('\n')[message.lineNum - 1]?.trim()}\``;
    if (errors.length > 0) faults.set(key, `${of}: ${errors.map(line).join('; ')}`);
    else if (refused && !messages.some(uniform)) faults.set(key, `${of}: ${refused.message}`);
  }
  const module = modules.get(key);
  if (module) {
    device.pushErrorScope('validation');
    device.createComputePipeline({ layout: 'auto', compute: { module, entryPoint: entry, constants } });
    const refused = await device.popErrorScope();
    if (refused) faults.set(key, `${of}: ${refused.message}`);
  }
}
for (const fault of faults.values()) console.error(fault);

const seen = new Set(shaders.flatMap((shader) => shader.files));
const files = readdirSync(root, { recursive: true }).filter((name) => name.endsWith('.wgsl'));
const missing = files.map((name) => `shaders/${name.replaceAll('\\', '/')}`).filter((name) => !seen.has(name));
if (missing.length > 0) console.error(`no list has ${missing.join(', ')}`);
console.log(`Tint compiled ${modules.size} shaders into ${shaders.length} pipelines, and refused ${faults.size}; of ${leftOut} that are for subgroups of eight lanes it was asked for errors but those of uniform control flow`);
process.exit(faults.size === 0 && missing.length === 0 && files.length > 0 ? 0 : 1);
