import "./style.css";
import { App } from "./app";
import type { PageData } from "./data";
import { element } from "./dom";
import { errorPage } from "./error_page";
import { applyTheme, initialTheme } from "./theme";

/** ms between two looks whether the scene has changed. */
const kLivePeriod = 500;

/** Under which the time that is shown outlives a reload. */
const kTimeKey = "trajet-time";

const page = document.getElementById("page")!;
const data = JSON.parse(document.getElementById("trajet-data")!.textContent!) as PageData | null;
applyTheme(initialTheme());
if (data?.error) page.append(errorPage(data.error));
else if (data?.runs) window.trajet = new App(page, data.runs, data.live ? keptTime() : undefined, data.scene_text);
else page.append(element("main", { class: "error" }, element("p", {}, "This page holds no run.")));
if (data?.live) void reloadWhenChanged(String(data.live));

/** The time that was shown before the scene changed, if any was. */
function keptTime(): number | undefined {
  const text = sessionStorage.getItem(kTimeKey);
  return text === null ? undefined : Number(text);
}

/** Asks the server, which answers with the number of the newest version, for another one than this page's `own`. */
async function reloadWhenChanged(own: string): Promise<void> {
  for (;;) {
    try {
      const version = await (await fetch("version", { cache: "no-store" })).text();
      if (version !== own) {
        if (window.trajet) sessionStorage.setItem(kTimeKey, String(window.trajet.time));
        return location.reload();
      }
    } catch {
      document.title = `${document.title.replace(/ \(stopped\)$/, "")} (stopped)`;
    }
    await new Promise((resume) => setTimeout(resume, kLivePeriod));
  }
}

declare global {
  interface Window {
    /** For scripts and the browser's console. */
    trajet?: App;
  }
}
