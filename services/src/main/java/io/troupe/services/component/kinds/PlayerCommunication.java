package io.troupe.services.component.kinds;

import io.troupe.actor.promise.Promise;
import io.troupe.player.PlayerClient;
import io.troupe.player.PlayerException;
import io.troupe.services.component.ComponentCommunication;
import io.troupe.services.component.kinds.PlayerSignal.Reading;
import io.troupe.services.component.kinds.PlayerSignal.SetSpeed;
import io.troupe.services.subsumption.DriverLimits;
import java.util.Map;
import java.util.TreeMap;
import org.jspecify.annotations.Nullable;

/** The CCU of a Player server: a Player client, which belongs to the actor space of the interface. */
final class PlayerCommunication implements ComponentCommunication<SetSpeed, Reading> {
    private final PlayerComponent.Settings settings;
    private final Map<Integer, PlayerRobot> robots = new TreeMap<>();
    private @Nullable PlayerClient client;
    private @Nullable Throwable lost;

    PlayerCommunication(PlayerComponent.Settings settings) {
        this.settings = settings;
    }

    @Override
    public Promise<@Nullable Void> invoke(Signals<? super Reading> signals) {
        var connected = new PlayerClient(settings.host(), settings.port());
        client = connected;
        try {
            DriverLimits.watch(connected);
            settings.robots()
                    .forEach(number -> robots.put(number - 1, new PlayerRobot(connected, number - 1, settings)));
            connected.runThreaded(-1, -1);
        } catch (RuntimeException refused) {
            connected.close();
            client = null;
            throw refused;
        }
        awaitData(connected, signals);
        return Promise.done();
    }

    private void awaitData(PlayerClient from, Signals<? super Reading> signals) {
        from.nextData().handle((ready, error) -> {
            if (client == null) {
                return null; // terminated: the client was closed
            }
            if (error != null) {
                lost = new PlayerException(settings.where() + ": " + error.getMessage(), error);
                signals.failed(lost);
                return null;
            }
            awaitData(from, signals);
            robots.values().forEach(robot -> robot.publishReadings(signals));
            return null;
        });
    }

    @Override
    public void data(SetSpeed command) {
        PlayerRobot robot = robots.get(command.index());
        if (robot != null) {
            robot.drive(command.speed(), command.turnRate());
        }
    }

    @Override
    public Promise<@Nullable Void> terminate() {
        PlayerClient ending = client;
        client = null;
        if (ending == null) {
            return Promise.done();
        }
        try {
            // the server may still execute commands even if it sends no data
            robots.values().forEach(PlayerRobot::stop);
        } catch (PlayerException unreachable) {
            if (lost == null) {
                throw unreachable;
            }
        } finally {
            ending.close();
        }
        return Promise.done();
    }

    @Override
    public Promise<@Nullable Void> health() {
        return lost == null ? Promise.done() : Promise.failed(lost);
    }
}
