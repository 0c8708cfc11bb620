// node compare_pictures.mjs [--keep] [--reduced N] FOUND KEPT [FOUND KEPT …]: says how pictures, reduced so many times, differ from
// those that are kept; with --keep keeps them instead.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, dirname } from "node:path";
import { parseArgs } from "node:util";

import { decoded, difference, encoded, reduced } from "./pictures.mjs";

const { values, positionals } = parseArgs({
  allowPositionals: true, options: { keep: { type: "boolean" }, reduced: { type: "string", default: "1" } },
});
const times = Number(values.reduced);
for (let i = 0; i < positionals.length; i += 2) {
  const [file, kept] = positionals.slice(i, i + 2), found = reduced(decoded(readFileSync(file)), times);
  if (values.keep) {
    mkdirSync(dirname(kept), { recursive: true });
    writeFileSync(kept, encoded(found, times > 1 ? 220 : 160));
    continue;
  }
  const said = existsSync(kept) ? difference(found, decoded(readFileSync(kept)), 8 / times) : "none is kept";
  if (said === "") continue;
  process.stdout.write(basename(kept, ".png") + ": " + said + "\n");
  process.exitCode = 1;
}
