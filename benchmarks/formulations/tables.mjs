// The tables of docs/formulations.md from what the benchmark has measured:
//
//     build/release/benchmarks/formulations_benchmark --benchmark_out=formulations.json --benchmark_out_format=json
//     node benchmarks/formulations/tables.mjs formulations.json
import { readFileSync } from "node:fs";

const read = (file) => JSON.parse(readFileSync(file, "utf8")).benchmarks;
const measured = process.argv.slice(2).flatMap(read).filter((b) => b.run_type === "iteration");
const machines = new Map(); // "chain in a plane 3" → formulation → "one" → counters
for (const benchmark of measured) {
  const [machine, size, formulation, what] = benchmark.name.split("/");
  const key = `${machine}, ${size}`;
  if (!machines.has(key)) machines.set(key, new Map());
  const of = machines.get(key);
  if (!of.has(formulation)) of.set(formulation, {});
  of.get(formulation)[what] = benchmark;
}

function digits(x, n = 2) {
  if (!Number.isFinite(x)) return "–";
  if (x >= 1000) return x.toFixed(0);
  return x !== 0 && x < 0.001 ? Number(x.toPrecision(n)).toExponential() : `${Number(x.toPrecision(n))}`;
}
const tables = new Map(); // formulations → machines
for (const [machine, of] of machines) {
  const key = [...of.keys()].join("|");
  tables.set(key, [...(tables.get(key) ?? []), [machine, of]]);
}

function table(title, cell, isThere) {
  for (const [key, rows] of tables) {
    const columns = key.split("|"), there = rows.filter(([, of]) => columns.some((c) => isThere(of.get(c))));
    if (there.length === 0) continue;
    console.log(`\n${title}\n\n| | ${columns.join(" | ")} |\n|---|${columns.map(() => "---|").join("")}`);
    for (const [machine, of] of there)
      console.log(`| ${machine} | ${columns.map((c) => (isThere(of.get(c)) ? cell(of.get(c), of.get(columns[0])) : "–")).join(" | ")} |`);
  }
}

table("Operations of one evaluation; its CPU time and that in packs, over those of the first column",
  (m, first) => {
    const [one, pack] = ["one", "pack"].map((what) => digits(m[what].cpu_time / first[what].cpu_time));
    return `${digits(m.one.operations, 3)}; ${one}, ${pack}`;
  }, (m) => m.one !== undefined);
const flow = (m, end) => (m.reached < end ? `to ${digits(m.reached)} s` : `${digits(m["ms/s"])} ms/s`);
table("Flow of all that is known, over 2 s: CPU time for a second of motion, or how far it came; the greatest width of a position",
  (m) => `${flow(m.thin, 2)}; ${digits(m.thin.width)}`, (m) => m.thin !== undefined);
table("Flow of three masses ± 1 %, over 0.5 s: likewise; the greatest width over that of samples",
  (m) => `${flow(m.percent, 0.5)}; ${digits(m.percent.loose || NaN, 3)}`, (m) => m.percent !== undefined);
