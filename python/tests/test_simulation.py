import copy
import gc
import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import unittest

import numpy as np

from common import BOUNDED, SHEAR, UNLIKE, FolderCase, enclosed, program
from meniscus import Case, Run, Simulation, plot
from misfits import WRONG_NUMBERS, WRONG_PATHS, WRONG_TEXTS


class RunTest(FolderCase):
    def run_program(self, case, name="program"):
        file = self.folder / "case.toml"
        file.write_text(case.to_toml(), encoding="utf-8")
        program("run", file, "-o", self.folder / name, "-q")
        return file, self.folder / name

    def status(self, folder):
        return json.loads((folder / "run.json").read_text(encoding="utf-8"))["status"]

    def test_the_same_bytes_as_the_program_by_either_solver(self):
        for tables in (SHEAR, BOUNDED):
            with self.subTest(tables["flow"]["kind"]):
                file, whole = self.run_program(Case.from_dict(tables), tables["flow"]["kind"])
                stepped = self.folder / (tables["flow"]["kind"] + "-stepped")
                with Simulation(file, stepped) as simulation:
                    while not simulation.is_finished:
                        simulation.step()
                    in_memory = simulation.history(), simulation.drops()
                self.assertSameRun(whole, stepped)
                for kept, name in zip(in_memory, ("history", "drops")):
                    read = getattr(Run(whole), name)()
                    self.assertEqual(list(kept), list(read))
                    for column in read:
                        np.testing.assert_array_equal(kept[column], read[column], column)
                        self.assertEqual(kept[column].dtype.kind, read[column].dtype.kind)
                one, other = (json.loads((folder / "run.json").read_text()) for folder in (whole, stepped))
                for key in ("case", "case_text", "status", "steps", "t", "constants"):
                    self.assertEqual(one[key], other[key], key)
                self.assertEqual(list(one), list(other))

    def test_a_run_goes_on_where_it_was_closed(self):
        file, whole = self.run_program(Case.from_dict(SHEAR))
        folder = self.folder / "parts"
        with Simulation(file, folder) as simulation:
            simulation.run(until=0.05)
            self.assertGreaterEqual(simulation.t, 0.05)
        self.assertEqual(self.status(folder), "stopped")
        with Simulation.resume(folder) as simulation:
            self.assertGreater(len(simulation.history()["t"]), 2)
            simulation.step()
        program("resume", folder, "-q")
        self.assertSameRun(whole, folder)
        with Simulation.resume(folder, until=0.25) as simulation:
            simulation.run()
            self.assertGreaterEqual(simulation.t, 0.25)
            history = simulation.history()
        self.assertEqual(list(history["step"]), list(range(len(history["step"]))))
        self.assertEqual(self.status(folder), "done")

    def test_a_checkpoint_goes_on_elsewhere(self):
        case = Case.from_dict(SHEAR)
        simulation = Simulation(case)
        simulation.run(until=0.1)
        simulation.checkpoint(self.folder / "middle.h5")
        simulation.run()
        alone = Simulation.resume(self.folder / "middle.h5")
        alone.run()
        np.testing.assert_array_equal(alone.interfaces[0].points, simulation.interfaces[0].points)
        self.assertEqual(alone.drops()["D"][-1], simulation.drops()["D"][-1])
        with Simulation.resume(self.folder / "middle.h5", self.folder / "new",
                               settings={"time.end": 0.15}) as other:
            other.run()
        self.assertEqual(self.status(self.folder / "new"), "done")
        with self.assertRaisesRegex(ValueError, "drop"):
            Simulation.resume(self.folder / "middle.h5", settings={"drop.nodes": 60})
        with self.assertRaisesRegex(ValueError, "output"):
            Simulation.resume(self.folder / "new", settings={"time.end": 0.3})
        with self.assertRaisesRegex(ValueError, "none.h5"):
            Simulation.resume(self.folder / "none.h5")

    def test_without_folder_nothing_is_written(self):
        before = set(os.listdir("."))
        with Simulation(Case.from_dict(SHEAR)) as simulation:
            simulation.run(until=0.05)
            self.assertIsNone(simulation.output)
            self.assertEqual(simulation.drops()["t"][-1], simulation.t)
        self.assertEqual(set(os.listdir(".")), before)

    def test_callbacks_come_after_each_step_and_may_pause(self):
        simulation, seen = Simulation(Case.from_dict(SHEAR)), []
        simulation.run(callback=lambda s: seen.append((s.step_number, s.t)) or np.bool_(len(seen) == 3))
        self.assertEqual([number for number, _ in seen], [1, 2, 3])
        self.assertEqual(seen[-1], (simulation.step_number, simulation.t))

        def fails(_):
            raise LookupError("mine")
        with self.assertRaisesRegex(LookupError, "mine"):
            simulation.run(callback=fails)
        self.assertEqual(simulation.step_number, 4)
        simulation.run()
        self.assertTrue(simulation.is_finished)
        simulation.run()
        with self.assertRaisesRegex(RuntimeError, "end"):
            simulation.step()

    def test_a_run_that_cannot_go_on_says_so_with_the_line_of_the_program(self):
        case = Case.from_dict(UNLIKE)
        file = self.folder / "unlike.toml"
        file.write_text(case.to_toml(), encoding="utf-8")
        said = program("run", file, "-o", self.folder / "run", "-q", status=1)
        simulation = Simulation(file, self.folder / "stepped")
        with self.assertRaises(RuntimeError) as caught:
            simulation.run()
        self.assertIn(str(caught.exception), said)
        with self.assertRaisesRegex(RuntimeError, "has failed"):
            simulation.step()
        self.assertEqual(len(simulation.interfaces), 2)
        simulation.close()
        self.assertSameRun(self.folder / "run", self.folder / "stepped")
        self.assertTrue(self.status(self.folder / "stepped").startswith("failed: "))

    def test_closed_simulations_and_wrong_arguments_are_refused(self):
        simulation = Simulation(Case.from_dict(SHEAR), self.folder / "run")
        with self.assertRaisesRegex(ValueError, "end of the case"):
            simulation.run(until=5)
        for wrong in ("soon", float("nan"), [1, 2]):
            with self.assertRaisesRegex(ValueError, "until"):
                simulation.run(until=wrong)
        with self.assertRaisesRegex(ValueError, "is being written by"):
            Simulation(Case.from_dict(SHEAR), self.folder / "run", overwrite=True)
        simulation.close()
        simulation.close()
        self.assertTrue(simulation.is_closed)
        for use in (simulation.step, simulation.run, simulation.history, lambda: simulation.t,
                    lambda: simulation.interfaces, lambda: simulation.checkpoint("x.h5"),
                    lambda: simulation.set_flow("quiescent")):
            with self.assertRaisesRegex(ValueError, "closed"):
                use()
        with self.assertRaisesRegex(ValueError, "holds a run already"):
            Simulation(Case.from_dict(SHEAR), self.folder / "run")
        Simulation(Case.from_dict(SHEAR), self.folder / "run", overwrite=True).close()

    def test_a_simulation_that_is_let_go_leaves_a_run_to_resume(self):
        folder = self.folder / "run"
        file, whole = self.run_program(Case.from_dict(SHEAR))
        simulation = Simulation(file, folder)
        simulation.step()
        del simulation
        gc.collect()
        self.assertEqual(self.status(folder), "stopped")
        code = (f"import meniscus\ns = meniscus.Simulation.resume({str(folder)!r})\ns.step()\n")
        subprocess.run([sys.executable, "-c", code], check=True)
        self.assertEqual(self.status(folder), "stopped")
        program("resume", folder, "-q")
        self.assertSameRun(whole, folder)

    def test_ctrl_c_acts_between_steps(self):
        folder = self.folder / "run"
        simulation = Simulation(Case.from_dict(SHEAR | {"time": {"end": 50.0, "max-step": 0.02}}), folder)
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            simulation.run()
        timer.join()
        self.assertEqual(self.status(folder), "stopped")
        steps = simulation.step_number
        self.assertEqual(len(simulation.history()["t"]), steps + 1)
        simulation.step()
        self.assertEqual(simulation.step_number, steps + 1)
        self.assertEqual(self.status(folder), "running")

    def test_ctrl_c_while_the_first_state_is_made_leaves_a_run_to_resume(self):
        folder = self.folder / "run"
        timer = threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT))
        slow = BOUNDED | {"drop": [{"radius": 1.0, "nodes": 400}]}
        with self.assertRaises(KeyboardInterrupt):
            case = Case.from_dict(slow)
            timer.start()
            Simulation(case, folder)
        timer.join()
        self.assertEqual(self.status(folder), "stopped")
        with Simulation.resume(folder) as simulation:
            self.assertEqual(simulation.step_number, 0)

    def test_simulations_in_threads_compute_in_turn(self):
        file, whole = self.run_program(Case.from_dict(SHEAR))
        folders = [self.folder / f"run {i}" for i in range(3)]

        def go(folder):
            with Simulation(file, folder) as simulation:
                simulation.run()
        threads = [threading.Thread(target=go, args=(folder,)) for folder in folders]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for folder in folders:
            self.assertSameRun(whole, folder)

    def test_a_program_ends_after_the_step_of_a_thread_in_hand(self):
        code = ("import threading, time\nfrom meniscus import Simulation\n"
                f"case = {SHEAR | {'time': {'end': 50.0, 'max-step': 0.02}}!r}\n"
                "idle = Simulation(case, 'idle')\nbusy = Simulation(case, 'busy')\n"
                "threading.Thread(target=busy.run, daemon=True).start()\ntime.sleep(0.2)\n")
        done = subprocess.run([sys.executable, "-c", code], cwd=self.folder, capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("idle", "busy"):
            self.assertEqual(self.status(self.folder / name), "stopped")
            Simulation.resume(self.folder / name).step()

    def test_a_process_that_is_forked_off_ends_without_closing(self):
        code = ("import os, threading, time\nfrom meniscus import Simulation\n"
                f"case = {SHEAR | {'time': {'end': 50.0, 'max-step': 0.02}}!r}\n"
                "idle = Simulation(case, 'idle')\nbusy = Simulation(case)\n"
                "threading.Thread(target=busy.run, daemon=True).start()\ntime.sleep(0.1)\n"
                "child = os.fork()\n"
                "if child == 0:\n    raise SystemExit\n"
                "assert os.waitpid(child, 0)[1] == 0\n"
                "assert 'running' in open('idle/run.json').read()\n")
        done = subprocess.run([sys.executable, "-c", code], cwd=self.folder, capture_output=True, text=True,
                              check=False, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.status(self.folder / "idle"), "stopped")

    def test_relative_names_stay_where_they_were_given(self):
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        (self.folder / "sub").mkdir()
        os.chdir(self.folder)
        simulation = Simulation(SHEAR, "run")
        case = Case.from_dict(SHEAR, ".")
        os.chdir("sub")
        simulation.run()
        simulation.close()
        self.assertEqual(self.status(self.folder / "run"), "done")
        self.assertEqual(case._core.folder.resolve(), self.folder.resolve())

    def test_a_checkpoint_knows_what_rules_look_back_to(self):
        tables = SHEAR | {"time": {"end": 20.0, "max-step": 0.2, "stop-when": {"steady-rate": 0.05}}}
        simulation = Simulation(tables)
        simulation.run(until=1.8)
        simulation.checkpoint(self.folder / "middle.h5")
        simulation.run()
        self.assertLess(simulation.t, 19.0)
        resumed = Simulation.resume(self.folder / "middle.h5")
        resumed.run()
        self.assertEqual(resumed.t, simulation.t)

    def test_an_end_in_seconds_is_reached(self):
        tables = SHEAR | {"scale": {"length": 1e-3, "viscosity": 0.1, "surface-tension": 0.025, "rate": 10.0},
                          "flow": {"kind": "simple-shear"}, "drop": [{"radius": 1e-3, "nodes": 42}],
                          "time": {"end": 0.01, "max-step": 0.01}, "output": {"interval": 0.01}}
        simulation = Simulation(tables)
        simulation.run(until=0.1)
        self.assertTrue(simulation.is_finished)

    def test_a_simulation_is_not_copied(self):
        simulation = Simulation(SHEAR)
        for copied in (copy.copy, copy.deepcopy, pickle.dumps):
            with self.assertRaisesRegex(TypeError, "checkpoint"):
                copied(simulation)
        simulation.step()

    def test_other_threads_go_on_and_may_not_step_too(self):
        simulation = Simulation(Case.from_dict(SHEAR))
        refused, beats, is_over = [], [], threading.Event()

        def intrude():
            while not is_over.is_set():
                beats.append(1)
                try:
                    simulation.t
                except ValueError as error:
                    refused.append(str(error))
        thread = threading.Thread(target=intrude)
        thread.start()
        simulation.run()
        is_over.set()
        thread.join()
        self.assertTrue(simulation.is_finished)
        self.assertGreater(len(beats), 10)
        self.assertTrue(all("another thread" in line for line in refused))


class RefusalTest(FolderCase):
    def test_simulations_begin_with_sound_arguments_only(self):
        folder = self.folder / "run"
        for wrong in WRONG_PATHS:
            if not isinstance(wrong, dict):
                with self.assertRaisesRegex(ValueError, "^case ", msg=wrong):
                    Simulation(wrong, folder)
            with self.assertRaisesRegex(ValueError, "^path ", msg=wrong):
                Simulation.resume(wrong, folder)
            if wrong is not None:
                with self.assertRaisesRegex(ValueError, "^output ", msg=wrong):
                    Simulation(SHEAR, wrong)
        for wrong in (3, "no", None, []):
            with self.assertRaisesRegex(ValueError, "overwrite must be True or False"):
                Simulation(SHEAR, folder, overwrite=wrong)
        self.assertFalse(folder.exists())
        Simulation(SHEAR, folder).close()
        with self.assertRaisesRegex(ValueError, "give overwrite=True or another output$"):
            Simulation(SHEAR, folder)

    def test_a_run_that_has_ended_is_resumed_at_its_end(self):
        folder = self.folder / "ended"
        with Simulation(SHEAR, folder) as simulation:
            simulation.run()
        with Simulation.resume(folder) as simulation:
            self.assertTrue(simulation.is_finished)

    def test_runs_are_resumed_with_sound_arguments_only(self):
        file = self.folder / "middle.h5"
        simulation = Simulation(SHEAR)
        simulation.step()
        simulation.checkpoint(file)
        for wrong in (3, "", [1], True):
            with self.assertRaisesRegex(ValueError, "settings must be a dict"):
                Simulation.resume(file, settings=wrong)
        for wrong in (*WRONG_NUMBERS[1:], float("nan")):
            with self.assertRaisesRegex(ValueError, "^until ", msg=wrong):
                Simulation.resume(file, until=wrong)
        for arguments, words in (({"until": -1}, "until = -1.0 must be at least 0"),
                                 ({"until": 1e-9}, "until = 1e-09 lies before"),
                                 ({"until": 0.3, "settings": {"time.end": 0.4}}, "until and settings both"),
                                 ({"settings": {"drop.nodes": 60}}, "drop.nodes: liquids, drops, domain"),
                                 ({"settings": {"time.max-step": -1}}, "time.max-step = -1.0 must be")):
            with self.assertRaisesRegex(ValueError, f"^{words}"):
                Simulation.resume(file, self.folder / "new", **arguments)
        self.assertFalse((self.folder / "new").exists())

    def test_what_a_run_cannot_do_is_refused_before_a_step(self):
        simulation = Simulation(SHEAR)
        for wrong in (3, "x", [], lambda: None, lambda one, two: None):
            with self.assertRaisesRegex(ValueError, "^callback must be a function of one argument"):
                simulation.run(callback=wrong)
        for wrong in WRONG_NUMBERS[1:]:
            with self.assertRaisesRegex(ValueError, "^until ", msg=wrong):
                simulation.run(until=wrong)
        self.assertEqual(simulation.step_number, 0)
        for wrong in (*WRONG_PATHS, self.folder, self.folder / "none/x.h5"):
            with self.assertRaisesRegex(ValueError, "^path", msg=wrong):
                simulation.checkpoint(wrong)
        self.assertEqual(os.listdir(self.folder), [])
        simulation.close()
        with self.assertRaisesRegex(ValueError, "closed"), simulation:
            pass

    def test_a_flow_that_cannot_be_is_refused_in_words_of_the_arguments(self):
        simulation = Simulation(SHEAR)
        for wrong in WRONG_TEXTS[:2] + WRONG_TEXTS[3:]:
            with self.assertRaisesRegex(ValueError, "^kind ", msg=wrong):
                simulation.set_flow(wrong)
        for name in ("factor", "ramp"):
            for wrong in (*WRONG_NUMBERS[1:], float("nan"), float("inf")):
                with self.assertRaisesRegex(ValueError, f"^{name} ", msg=wrong):
                    simulation.set_flow(**({"factor": 1.0} | {name: wrong}))
        for arguments, words in (({}, "set_flow needs one of kind, gradient, factor"),
                                 ({"kind": "sheer"}, 'kind = "sheer" must be one of "simple-shear"'),
                                 ({"gradient": np.eye(3)}, "gradient = .* has the trace 3"),
                                 ({"gradient": np.zeros((3, 3)) * 1j}, "gradient: a value of type complex"),
                                 ({"gradient": [[1, 2]]}, r"gradient = \[\[1, 2\]\] must be three rows"),
                                 ({"kind": "quiescent", "ramp": -1}, "ramp = -1.0 must be at least 0"),
                                 ({"kind": "quiescent", "gradient": np.zeros((3, 3))}, "gradient = .* kind")):
            with self.assertRaisesRegex(ValueError, f"^{words}"):
                simulation.set_flow(**arguments)
        self.assertNotIn("flow.schedule", simulation.case)
        flow = SHEAR["flow"] | {"schedule": [{"time": 0.1, "factor": 0.0}]}
        with self.assertRaisesRegex(ValueError, "^the flow cannot change at t = 0"):
            Simulation(SHEAR | {"flow": flow}).set_flow("quiescent")

    def test_folders_of_runs_are_asked_with_sound_arguments_only(self):
        folder = self.folder / "run"
        with Simulation(SHEAR, folder) as simulation:
            simulation.step()
        run = Run(folder)
        for wrong in WRONG_PATHS:
            with self.assertRaisesRegex(ValueError, "^folder ", msg=wrong):
                Run(wrong)
        for wrong in WRONG_NUMBERS:
            for ask in (run.shape, run.volume):
                with self.assertRaisesRegex(ValueError, "^t ", msg=wrong):
                    ask(wrong)
            with self.assertRaisesRegex(ValueError, "^number ", msg=wrong):
                run.shape(0).drop(wrong)

    def test_broken_files_of_a_run_are_named(self):
        (self.folder / "history.csv").write_text("step,t\n0,0.5\n1,x\n", encoding="utf-8")
        with self.assertRaisesRegex(ValueError, "history.csv:3: t must be a number, not 'x'"):
            Run(self.folder).history()
        (self.folder / "history.csv").write_text("step,t\n0.5,0\n", encoding="utf-8")
        with self.assertRaisesRegex(ValueError, "history.csv:2: step must be a whole number, not '0.5'"):
            Run(self.folder).history()
        for text, words in (("[]", "must hold an object"), ("{}", "status is missing"), ("{", "cannot be read")):
            (self.folder / "run.json").write_text(text, encoding="utf-8")
            with self.assertRaisesRegex(ValueError, f"run.json: {words}"):
                Run(self.folder).status

    def test_pictures_of_what_is_none_are_refused_and_leave_no_figure(self):
        import matplotlib.pyplot as plt
        with Simulation(SHEAR, self.folder / "run") as simulation:
            simulation.step()
            shape = simulation.interfaces[0]
        run = Run(self.folder / "run")
        before = plt.get_fignums()
        for wrong in (3, None, "none", run.folder, {}, [3], [shape, 3], (shape.points, shape.triangles)):
            with self.assertRaisesRegex(ValueError, "^source must be", msg=wrong):
                plot.interface(wrong)
            with self.assertRaisesRegex(ValueError, "^source must be", msg=wrong):
                plot.history(wrong)
        for draw, words in ((lambda: plot.interface(simulation), "closed"), (lambda: plot.interface([]), "no surface"),
                            (lambda: plot.history(simulation), "closed"),
                            (lambda: plot.interface(run, "x"), "t must be a number"),
                            (lambda: plot.interface(shape, 1.0), "t = 1.0: only a Run"),
                            (lambda: plot.interface(run, color=3), "color must be a text"),
                            (lambda: plot.interface(run, cmap=3), "cmap must be the name"),
                            (lambda: plot.interface(run, ax=3), "ax must be axes"),
                            (lambda: plot.history(run, ax=3), "ax must be axes"),
                            (lambda: plot.history(run, 3), "columns must be a name"),
                            (lambda: plot.history(run, []), "columns must name one"),
                            (lambda: plot.history(run, ["D", 3]), "a name in columns must be a text"),
                            (lambda: plot.history(run, "step_bound"), "holds words")):
            with self.assertRaisesRegex(ValueError, words):
                draw()
        self.assertEqual(plt.get_fignums(), before)


class ArrayTest(FolderCase):
    def test_interfaces_have_the_shape_and_fields_of_the_frames(self):
        folder = self.folder / "run"
        with Simulation(Case.from_dict(SHEAR), folder) as simulation:
            simulation.run()
            drop = simulation.interfaces[0]
        shape = Run(folder).shape(simulation_end := 9.0)
        self.assertLess(shape.t, simulation_end)
        np.testing.assert_array_equal(drop.triangles, shape.triangles)
        np.testing.assert_allclose(drop.points, shape.points, rtol=1e-6)
        self.assertEqual(set(drop.fields), set(shape.fields))
        ends = shape.points[shape.triangles]
        edges = np.linalg.norm(ends - np.roll(ends, -1, axis=1), axis=2)
        above = np.linalg.norm(shape.middles - 0.5 * (ends + np.roll(ends, -1, axis=1)), axis=2)
        self.assertTrue(np.all((above > 0) & (above < 0.5 * edges)))
        for name, values in drop.fields.items():
            np.testing.assert_allclose(values, shape.fields[name], rtol=1e-5, atol=1e-5)
        self.assertEqual((drop.drop, drop.parent), (0, -1))
        self.assertEqual(drop.points.dtype, np.float64)
        self.assertEqual(drop.triangles.max(), len(drop.points) - 1)

    def test_volume_meshes_hold_the_flow(self):
        simulation = Simulation(Case.from_dict(BOUNDED))
        simulation.step()
        mesh = simulation.volume_mesh
        x, cells = mesh.points, mesh.tetrahedra
        edges = x[cells[:, 1:]] - x[cells[:, :1]]
        volumes = np.linalg.det(edges) / 6.0
        self.assertGreater(volumes.min(), 0.0)
        drop = simulation.interfaces[0]
        self.assertAlmostEqual(volumes[mesh.region == 1].sum(), enclosed(drop.points, drop.triangles))
        self.assertEqual(mesh.velocity.shape, x.shape)
        self.assertEqual(mesh.pressure.shape, cells.shape)
        outer = np.linalg.norm(x, axis=1) > 2.999  # the imposed flow (x, -y, 0) on the boundary
        np.testing.assert_allclose(mesh.velocity[outer], x[outer] * [1, -1, 0], atol=1e-6)
        self.assertIsNone(Simulation(Case.from_dict(SHEAR)).volume_mesh)


class FlowTest(FolderCase):
    def test_a_gradient_and_a_ramp_are_in_the_units_of_t_with_a_scale_too(self):
        scaled = SHEAR | {"scale": {"length": 1e-3, "viscosity": 0.1, "surface-tension": 0.025, "rate": 50.0},
                          "flow": {"kind": "simple-shear"},
                          "drop": [{"radius": 1e-3, "nodes": 42}],
                          "time": {"end": 0.004, "max-step": 0.0004}, "output": {"interval": 0.001}}
        simulation = Simulation(scaled)
        before = simulation.interfaces[0].fields["velocity"]
        simulation.set_flow(gradient=np.array([[0, 1, 0], [0, 0, 0], [0, 0, 0]]), ramp=0.01)
        self.assertAlmostEqual(simulation.case["flow.schedule[0].ramp"], 0.0002)  # s
        np.testing.assert_allclose(simulation.case["flow.schedule[0].gradient"][0], [0, 50, 0])  # 1/s
        simulation.step()
        np.testing.assert_allclose(simulation.interfaces[0].fields["velocity"], before, atol=0.05)

    def test_the_flow_changes_while_it_runs_and_the_change_is_recorded(self):
        folder = self.folder / "run"
        with Simulation(Case.from_dict(SHEAR), folder) as simulation:
            simulation.run(until=0.1)
            t, step = simulation.t, simulation.step_number
            before = np.abs(simulation.interfaces[0].fields["velocity"]).max()
            simulation.set_flow("planar-extension")
            simulation.set_flow("quiescent")  # takes its place
            self.assertLess(np.abs(simulation.interfaces[0].fields["velocity"]).max(), 0.5 * before)
            self.assertEqual(simulation.case["flow.schedule[0].time"], t)
            self.assertEqual(simulation.case["flow.schedule[0].kind"], "quiescent")
            simulation.run(until=0.15)
            simulation.set_flow(gradient=[[0, -1, 0], [0, 0, 0], [0, 0, 0]], ramp=0.01)
            with self.assertRaisesRegex(ValueError, "trace"):
                simulation.set_flow(gradient=np.eye(3))
            with self.assertRaisesRegex(ValueError, "kind"):
                simulation.set_flow("sheer")
            simulation.step()
        record = json.loads((folder / "run.json").read_text(encoding="utf-8"))
        self.assertEqual(record["changes"][1]["step"], step)
        self.assertEqual(len(record["case"]["flow"]["schedule"]), 2)
        program("resume", folder, "-q")
        again = json.loads((folder / "run.json").read_text(encoding="utf-8"))
        self.assertEqual(again["changes"], record["changes"])
        self.assertEqual(again["status"], "done")

    def test_a_change_does_what_the_schedule_of_a_case_does(self):
        end = {"time": {"end": 0.3, "max-step": 0.02}}
        changed = Simulation(Case.from_dict(SHEAR | end))
        changed.run(until=0.1)
        t = changed.t
        changed.set_flow(factor=0)
        changed.run()
        flow = SHEAR["flow"] | {"schedule": [{"time": t, "factor": 0.0}]}
        planned = Simulation(Case.from_dict(SHEAR | end | {"flow": flow}))
        planned.run()
        self.assertAlmostEqual(changed.drops()["D"][-1], planned.drops()["D"][-1], delta=2e-5)


if __name__ == "__main__":
    unittest.main()
