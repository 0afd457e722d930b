// Genes that were copied from an individual, and where they fit into another.
import type { BredGene, DrawSetting } from "../api";

export interface CopiedGenes {
  individual: number;
  /** Of a single gene; absent: of all. */
  rule?: string;
  draws: readonly { path: string; rule: string; index: number; name: string; quantile: number }[];
}

export function copyGenes(individual: number, genes: readonly BredGene[], only?: BredGene): CopiedGenes {
  const draws = (only === undefined ? genes : [only]).flatMap((gene) =>
    gene.draws.map(({ index, name, quantile }) => ({ path: gene.path, rule: gene.rule, index, name, quantile })));
  return { individual, draws, ...(only === undefined ? {} : { rule: only.rule }) };
}

/** The settings that paste `copied` into `genes`: by path and draw; a single gene into the one that is meant, which must be of the
 *  same rule. What is the same already is left out. */
export function pasteGenes(copied: CopiedGenes, genes: readonly BredGene[], only?: BredGene): DrawSetting[] {
  const out: DrawSetting[] = [];
  for (const gene of only === undefined ? genes : [only]) {
    for (const draw of gene.draws) {
      const from = copied.draws.find((one) =>
        one.index === draw.index && one.name === draw.name && one.rule === gene.rule && (only !== undefined && copied.rule !== undefined ? true : one.path === gene.path));
      if (from !== undefined && from.quantile !== draw.quantile) out.push({ gene: gene.gene, index: draw.index, quantile: from.quantile });
    }
  }
  return out;
}
