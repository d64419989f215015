package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(60)
class ClientMessageHandlerTest {
    @Test
    void subscription_isConfirmed_whenTheDevicesKnowOfIt() throws InterruptedException {
        var ranger = new ScriptedRanger(Map.of());
        var outbox = new Outbox();
        var handler = new ClientMessageHandler("test", ranger, outbox, 1, 2);
        handler.handle(Hex.message(RawClient.bytes(new PlayerRequest.DataMode(Delivery.PULL))));
        outbox.take();
        var seen = new ArrayList<Thread.State>();
        ranger.whileSubscribing = () -> seen.add(stateOfTaker(outbox));
        handler.handle(Hex.message(RawClient.access(Interfaces.RANGER, PlayerRequest.OPEN)));
        assertThat(seen).as("whoever writes to the client").isEqualTo(List.of(Thread.State.WAITING));
    }

    /** State of a thread that takes output from the outbox: terminated or waiting. */
    private static Thread.State stateOfTaker(Outbox outbox) {
        Thread taker = Thread.ofPlatform().daemon().start(() -> {
            try {
                outbox.take();
            } catch (InterruptedException e) {
                throw new AssertionError(e);
            }
        });
        while (taker.getState() != Thread.State.WAITING && taker.getState() != Thread.State.TERMINATED) {
            Thread.onSpinWait();
        }
        return taker.getState();
    }
}
