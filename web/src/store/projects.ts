// The list of projects, and which of them is open.
import type { Ask } from "../connection/connection";
import { forgetProject } from "./state";
import type { Studio } from "./studio";

export class Projects {
  private firstList = true;
  /** The project that was deleted here, which needs no word when it is gone. */
  private deleted: number | null = null;

  /** `current`: the project that is open or wanted; null: the newest. */
  constructor(private readonly studio: Studio, private current: number | null) {}

  /** A connection stands: the next list is its first. */
  expectList(): void {
    this.firstList = true;
  }

  /** A document came of this project. */
  arrived(id: number): void {
    this.current = id;
  }

  /** The first list of a connection opens the project that was open, the one of the address, or the newest. A later one
   *  does so where the project that is open was deleted, here or by another page. */
  onList(): void {
    const first = this.firstList;
    this.firstList = false;
    const list = this.studio.state.projects.value;
    const open = this.studio.state.confirmed.value?.project.id;
    const gone = open !== undefined && !list.some((project) => project.id === open);
    if (gone) {
      if (open !== this.deleted) this.studio.tell("The project that was open is not there any more.", true);
      this.forget();
    }
    if (!first && !gone) return;
    const newest = [...list].sort((a, b) => b.changed - a.changed)[0]?.id;
    const id = list.some((project) => project.id === this.current) ? this.current! : newest;
    if (id === undefined) this.studio.state.dialog.value = "projects";
    else void this.open(id);
  }

  /** Nothing is open, and what was on its way to the project has nowhere to go. */
  private forget(): void {
    this.studio.edits.clear();
    this.studio.edits.pause();
    this.studio.room.onOtherProject();
    forgetProject(this.studio.state);
  }

  async open(id: number): Promise<boolean> {
    this.studio.edits.flush();
    const other = this.studio.state.confirmed.value !== null && this.studio.state.confirmed.value.project.id !== id;
    if (other) this.studio.edits.pause();
    const opened = await this.studio.ask({ kind: "open_project", project: id });
    if (opened) {
      if (other) {
        this.studio.edits.clear();
        this.studio.setTool("select");
      }
      this.studio.parked.opened(id);
      this.studio.edits.resume();
    } else if (this.studio.state.status.value.kind === "open") {
      if (other) this.studio.edits.resume();
      else this.studio.state.dialog.value = "projects";
    }
    return opened;
  }

  async create(name: string, sample?: string): Promise<void> {
    await this.openWhatAppears({ kind: "create_project", name, ...(sample === undefined ? {} : { sample }) });
  }

  async duplicate(id: number): Promise<void> {
    await this.studio.ask({ kind: "duplicate_project", project: id });
  }

  async delete(id: number): Promise<void> {
    this.deleted = id;
    if (!(await this.studio.ask({ kind: "delete_project", project: id }))) this.deleted = null;
  }

  async import(file: File): Promise<void> {
    try {
      const id = await this.studio.files.importProject(file);
      if (await this.open(id)) this.studio.state.dialog.value = null;
    } catch (error) {
      this.studio.tell(`${file.name} could not be imported: ${(error as Error).message}`, true);
    }
  }

  private async openWhatAppears(ask: Ask): Promise<void> {
    this.studio.edits.flush();
    const before = new Set(this.studio.state.projects.value.map((project) => project.id));
    if (!(await this.studio.ask(ask))) return;
    const made = this.studio.state.projects.value.find((project) => !before.has(project.id));
    if (made !== undefined && this.studio.state.confirmed.value?.project.id !== made.id) await this.open(made.id);
    else this.studio.edits.resume();
    this.studio.state.dialog.value = null;
  }
}
