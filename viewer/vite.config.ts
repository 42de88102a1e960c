import { defineConfig, type Plugin } from "vite";

/** Puts the script and the style sheet into the page itself, which then needs no other file. */
function singleFile(): Plugin {
  return {
    name: "single-file",
    enforce: "post",
    generateBundle(_options, bundle) {
      const page = bundle["index.html"];
      if (page?.type !== "asset") throw new Error("no index.html in the bundle");
      let html = String(page.source);
      for (const [name, file] of Object.entries(bundle)) {
        const isScript = file.type === "chunk";
        if (!isScript && !name.endsWith(".css")) continue;
        const text = isScript ? file.code.replaceAll("</script", "<\\/script") : String(file.source);
        const element = new RegExp(`<(script|link)\\b[^>]*"[^"]*${name.replaceAll(".", "\\.")}"[^>]*>(</script>)?`);
        if (!element.test(html)) throw new Error(`the page does not refer to ${name}`);
        // A module runs behind the whole page; the classic script that it becomes stands at the end instead.
        html = isScript
          ? html.replace(element, "").replace("</body>", () => `<script>${text}</script></body>`)
          : html.replace(element, () => `<style>${text}</style>`);
        delete bundle[name];
      }
      page.source = html;
    },
  };
}

export default defineConfig({
  build: {
    target: "es2022",
    emptyOutDir: true,
    modulePreload: false,
    assetsInlineLimit: Number.MAX_SAFE_INTEGER,
    chunkSizeWarningLimit: 1500,
    rollupOptions: { output: { format: "iife", entryFileNames: "page.js", assetFileNames: "page[extname]" } },
  },
  plugins: [singleFile()],
  test: { include: ["tests/**/*.test.ts"] },
} as Parameters<typeof defineConfig>[0]);
