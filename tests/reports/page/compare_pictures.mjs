// node compare_pictures.mjs FOUND KEPT: says how a picture differs from the one that is kept; with --keep keeps it instead.
import { existsSync, readFileSync, writeFileSync } from "node:fs";

import { decoded, difference, encoded } from "./pictures.mjs";

const [first, ...others] = process.argv.slice(2);
if (first === "--keep") {
  writeFileSync(others[1], encoded(decoded(readFileSync(others[0]))));
} else {
  const kept = others[0];
  const said = existsSync(kept) ? difference(decoded(readFileSync(first)), decoded(readFileSync(kept))) : "none is kept";
  process.stdout.write(said);
  process.exitCode = said === "" ? 0 : 1;
}
