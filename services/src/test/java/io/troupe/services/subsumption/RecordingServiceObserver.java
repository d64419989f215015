package io.troupe.services.subsumption;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

/** Records which services drive which robot. */
final class RecordingServiceObserver implements ServiceObserver {
    private final Map<Integer, List<Service>> inCharge = new TreeMap<>();
    private int most;
    private int coloursSent;

    @Override
    public void serviceStarted(int robot, Service service) {
        var services = inCharge.computeIfAbsent(robot, each -> new ArrayList<>());
        services.add(service);
        most = Math.max(most, services.size());
    }

    @Override
    public void cycleEnded(int robot, Service service) {}

    @Override
    public void serviceEnded(int robot, Service service) {
        inCharge.get(robot).remove(service);
    }

    @Override
    public void colourSent(int robot, int colour) {
        coloursSent++;
    }

    int coloursSent() {
        return coloursSent;
    }

    List<Service> of(int robot) {
        return List.copyOf(inCharge.getOrDefault(robot, List.of()));
    }

    /** The maximum number of services that a robot had at the same time. */
    int most() {
        return most;
    }
}
