// What the page's scripts are held to beside their types.
const limits = {
  "complexity": ["error", 20],
  "max-depth": ["error", 4],
  "max-len": ["error", 150],
  "max-lines-per-function": ["error", 60],
  "max-params": ["error", 7],
};
const refused = [
  "consistent-return", "default-case-last", "no-cond-assign", "no-console", "no-constant-condition", "no-debugger", "no-dupe-else-if",
  "no-duplicate-imports", "no-else-return", "no-empty", "no-eval", "no-fallthrough", "no-global-assign", "no-implicit-globals",
  "no-implied-eval", "no-lonely-if", "no-loop-func", "no-self-compare", "no-shadow", "no-throw-literal", "no-undef-init",
  "no-unneeded-ternary", "no-unreachable", "no-unsafe-optional-chaining", "no-unused-expressions", "no-unused-vars", "no-useless-return",
  "no-var", "object-shorthand", "prefer-const", "prefer-object-spread", "prefer-rest-params",
];

export default [{
  files: ["reports/page/*.js", "tests/reports/page/*.mjs"],
  linterOptions: { reportUnusedDisableDirectives: "error" },
  rules: { ...limits, ...Object.fromEntries(refused.map(rule => [rule, "error"])), "eqeqeq": ["error", "always", { null: "ignore" }] },
}];
