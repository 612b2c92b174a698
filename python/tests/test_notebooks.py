import contextlib
import io
import json
import unittest

from common import ROOT, FolderCase


class NotebookTest(FolderCase):
    def test_notebooks_hold_no_output_and_run(self):
        import matplotlib
        matplotlib.use("Agg")
        files = sorted((ROOT / "examples/notebooks").glob("*.ipynb"))
        self.assertEqual(len(files), 2)
        for file in files:
            with self.subTest(file.name):
                cells = json.loads(file.read_text(encoding="utf-8"))["cells"]
                names = {"__name__": "__main__"}
                for cell in cells:
                    if cell["cell_type"] != "code":
                        continue
                    self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None))
                    code = compile("".join(cell["source"]), f"{file.name} {cell['id']}", "exec")
                    with contextlib.redirect_stdout(io.StringIO()):
                        exec(code, names)
            matplotlib.pyplot.close("all")


if __name__ == "__main__":
    unittest.main()
