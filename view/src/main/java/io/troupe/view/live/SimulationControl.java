package io.troupe.view.live;

import io.troupe.actor.Clock;
import io.troupe.sim.Pace;
import io.troupe.sim.Simulation;
import io.troupe.sim.SimulationRunner;
import io.troupe.view.live.ViewCommand.Intervention;
import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * Carries out the commands of viewers on a simulation whose ticks a {@link SimulationRunner} makes.
 *
 * <p><b>Threads.</b> Any thread.
 */
public final class SimulationControl implements ViewControl {
    private final Simulation simulation;
    private final HandDriving driving = new HandDriving(Clock.system());
    private final List<Intervention> carriedOut = new ArrayList<>(); // since the last tick
    private volatile double speed;
    private volatile @Nullable SimulationRunner runner;

    /** @param speed at which the runner runs; 0 = as fast as the clients answer */
    public SimulationControl(Simulation simulation, double speed) {
        this.simulation = simulation;
        this.speed = speed;
    }

    /** Changes of speed go to this runner from now on. */
    public void runner(SimulationRunner newRunner) {
        runner = newRunner;
    }

    /**
     * To be called after each tick: ends what viewers that have left were doing.
     *
     * @return the interventions since the last call
     */
    public synchronized List<Intervention> ticked() {
        for (int robot : driving.takeSilent()) {
            simulation.endOverride(robot);
            carriedOut.add(new ViewCommand.Release(robot));
        }
        var taken = List.copyOf(carriedOut);
        carriedOut.clear();
        return taken;
    }

    @Override
    public List<String> offers() {
        return RunControl.ALL;
    }

    @Override
    public synchronized void submit(ViewCommand command) {
        switch (command) {
            case ViewCommand.Pause() -> simulation.pause();
            case ViewCommand.Resume() -> simulation.resume();
            case ViewCommand.Step() -> {
                simulation.pause();
                simulation.step();
            }
            case ViewCommand.Speed(double factor) -> {
                SimulationRunner running = runner;
                if (running == null) {
                    throw new IllegalArgumentException("the world has not begun to run");
                }
                running.pace(factor == 0 ? new Pace.OfAnswers() : new Pace.RealTime(factor));
                speed = factor;
            }
            case Intervention intervention -> {
                carryOut(intervention, simulation);
                driving.note(intervention);
                carriedOut.add(intervention);
            }
        }
    }

    @Override
    public boolean isPaused() {
        return simulation.isPaused();
    }

    @Override
    public String waitsFor() {
        SimulationRunner running = runner;
        return running != null && running.isWaitingForClients() ? "clients" : "";
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
            case ViewCommand.PutBox(var box) -> simulation.putBox(box);
            case ViewCommand.RemoveBox(int number) -> simulation.removeBox(number);
        }
    }
}
