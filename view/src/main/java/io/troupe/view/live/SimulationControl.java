package io.troupe.view.live;

import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.view.live.ViewCommand.Intervention;
import java.util.List;

/** Carries out the commands of viewers on a simulation whose ticks a {@link SimulationRunner} makes. */
public final class SimulationControl implements ViewControl {
    private final Simulation simulation;
    private final SimulationRunner runner;
    private volatile double speed;

    /** @param speed at which the runner runs; 0 = as fast as possible */
    public SimulationControl(Simulation simulation, SimulationRunner runner, double speed) {
        this.simulation = simulation;
        this.runner = runner;
        this.speed = speed;
    }

    @Override
    public List<String> offers() {
        return RunControl.ALL;
    }

    @Override
    public void submit(ViewCommand command) {
        switch (command) {
            case ViewCommand.Pause() -> simulation.pause();
            case ViewCommand.Resume() -> simulation.resume();
            case ViewCommand.Step() -> {
                simulation.pause();
                simulation.step();
            }
            case ViewCommand.Speed(double factor) -> {
                runner.pace(factor == 0 ? new Pace.Unlimited() : new Pace.RealTime(factor));
                speed = factor;
            }
            case Intervention intervention -> carryOut(intervention, simulation);
        }
    }

    @Override
    public boolean isPaused() {
        return simulation.isPaused();
    }

    @Override
    public double speed() {
        return speed;
    }

    /**
     * Changes the world before its next interval.
     *
     * @throws IllegalArgumentException if that is impossible there
     */
    static void carryOut(Intervention intervention, Simulation simulation) {
        switch (intervention) {
            case ViewCommand.Reset() -> simulation.reset();
            case ViewCommand.Place(int robot, var pose) -> simulation.teleport(robot, pose);
            case ViewCommand.Drive(int robot, double forwardMps, double turnRadps) ->
                simulation.override(robot, forwardMps, turnRadps);
            case ViewCommand.Release(int robot) -> simulation.endOverride(robot);
        }
    }
}
