package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import io.troupe.actor.Clock;
import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.util.AbstractList;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CountDownLatch;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

@Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD) // waiting for a lock cannot be interrupted
class OutboxTest {
    private static final DeviceAddress POSITION = new DeviceAddress(1, 2, 4, 0);
    private static final DeviceAddress SONAR = new DeviceAddress(1, 2, 5, 0);

    private final Outbox outbox = new Outbox();

    private static WireMessage reply(int subtype) {
        return WireMessage.of(new DeviceAddress(1, 2, 1, 0), MessageType.ACK, subtype, 0, Content.NONE);
    }

    private static DeviceDataMessage position(double px) {
        return new DeviceDataMessage(POSITION, 0, new DeviceData.Position2d(px, 0, 0, 0, 0, 0, false));
    }

    private static DeviceDataMessage sonar() {
        return new DeviceDataMessage(SONAR, 0, new DeviceData.SonarRanges(List.of()));
    }

    private void frame(long tick, DeviceDataMessage... messages) {
        outbox.frame(tick, tick / 10.0, List.of(messages));
    }

    /** The tick that the request for the next data answers. */
    private long ask() {
        return outbox.ask(reply(4));
    }

    private void rule(int interfaceCode, int type, int subtype, int replace) {
        outbox.add(new ReplaceRule(interfaceCode, -1, type, subtype, replace));
    }

    private void push() {
        outbox.subscribed(POSITION, reply(3));
    }

    private void pull() {
        push();
        outbox.subscribed(SONAR, reply(3));
        outbox.mode(Delivery.PULL);
        sent();
    }

    private interface Waiting {
        void run() throws InterruptedException;
    }

    private static Thread start(Waiting action) {
        return Thread.ofPlatform().daemon().start(() -> {
            try {
                action.run();
            } catch (InterruptedException e) {
                throw new AssertionError(e);
            }
        });
    }

    /** Everything that would be written now, in short form: ACK 3, position 1, .. */
    private List<String> sent() {
        var bytes = new ByteArrayOutputStream();
        try {
            while (true) {
                outbox.greet(Content.NONE); // so that take() never waits
                byte[] batch = outbox.take();
                if (batch.length == 0) {
                    break;
                }
                bytes.writeBytes(batch);
            }
            var reader = new MessageReader(new ByteArrayInputStream(bytes.toByteArray()), 1 << 16);
            var texts = new ArrayList<String>();
            for (WireMessage each = reader.read(); each != null; each = reader.read()) {
                texts.add(text(each));
            }
            return texts;
        } catch (IOException | WireException | InterruptedException e) {
            throw new AssertionError(e);
        }
    }

    private static String text(WireMessage message) throws WireException {
        int code = message.header().address().interfaceCode();
        int subtype = message.header().subtype();
        return switch (message.header().type()) {
            case DATA ->
                DataCodec.decode(code, subtype, message.payload()).orElseThrow() instanceof DeviceData.Position2d state
                        ? "position " + (int) state.px()
                        : "sonar";
            case SYNCH -> "SYNCH " + subtype + " " + PlayerDeviceCodec.dropped(subtype, message.payload());
            default -> message.header().type() + " " + subtype;
        };
    }

    @Test
    void push_sendsAsItComes_whatHasBeenSubscribed() {
        push();
        frame(0, position(0), sonar());
        outbox.reply(reply(1));
        frame(1, position(1));
        assertThat(sent()).containsExactly("ACK 3", "position 0", "ACK 1", "position 1");
    }

    @Test
    void pull_holdsDataUntilAsked_andEndsTheFrame() {
        pull();
        frame(0, position(0), sonar());
        frame(1, position(1));
        assertThat(sent()).isEmpty();
        assertThat(ask()).as("answered").isEqualTo(PlayerConnection.NO_TICK);
        assertThat(sent()).containsExactly("ACK 4", "position 0", "sonar", "position 1", "SYNCH 1 0");
        assertThat(ask()).isEqualTo(1);
        assertThat(sent()).containsExactly("ACK 4");
        frame(2, position(2));
        frame(3, position(3));
        assertThat(sent()).containsExactly("position 2", "SYNCH 1 0");
        assertThat(ask()).isEqualTo(2);
    }

    @Test
    void pull_replyFlushesWhatWasQueuedBefore() {
        pull();
        frame(0, position(0));
        outbox.reply(reply(1));
        frame(1, position(1));
        assertThat(sent()).containsExactly("position 0", "ACK 1");
        assertThat(ask()).as("answered, as no frame has ended").isEqualTo(PlayerConnection.NO_TICK);
        assertThat(sent()).containsExactly("ACK 4", "position 1", "SYNCH 1 0");
        assertThat(ask()).isEqualTo(1);
    }

    @Test
    void pull_dataSentBeforeAReply_areAnsweredByTheNextRequestForData_withoutAnEnd() {
        pull();
        frame(0, position(0));
        outbox.reply(reply(1));
        assertThat(sent()).containsExactly("position 0", "ACK 1");
        assertThat(ask()).as("answered").isZero();
        assertThat(sent()).as("no end without data").containsExactly("ACK 4");
        frame(1, position(1));
        outbox.reply(reply(1));
        assertThat(sent()).containsExactly("position 1", "SYNCH 1 0", "ACK 1");
    }

    @Test
    void pull_inLockStep_dataWaitForTheirRequest_whateverIsRepliedBefore() {
        outbox.inLockStep(() -> true);
        pull();
        frame(0, position(0));
        outbox.reply(reply(1));
        outbox.subscribed(SONAR, reply(3));
        outbox.unsubscribed(SONAR, reply(3));
        assertThat(sent()).containsExactly("ACK 1", "ACK 3", "ACK 3");
        assertThat(ask()).as("answered").isEqualTo(PlayerConnection.NO_TICK);
        assertThat(sent()).containsExactly("ACK 4", "position 0", "SYNCH 1 0");
        assertThat(ask()).as("answered").isZero();
    }

    @Test
    void pull_dataSentBeforeASubscription_areAnsweredByTheNextRequestForData_withoutAnEnd() {
        pull();
        frame(0, position(0));
        outbox.subscribed(SONAR, reply(3));
        assertThat(ask()).as("answered").isZero();
        outbox.unsubscribed(SONAR, reply(3));
        assertThat(sent()).containsExactly("position 0", "ACK 3", "ACK 4", "ACK 3");
    }

    @Test
    void push_thenPull_nothingIsLeftToEnd_andBackToPush_releasesWhatWaits() {
        push();
        frame(0, position(0));
        outbox.mode(Delivery.PULL);
        sent();
        assertThat(ask()).as("answered").isZero();
        assertThat(sent()).containsExactly("ACK 4");
        frame(1, position(1));
        assertThat(sent()).containsExactly("position 1", "SYNCH 1 0");
        frame(2, position(2));
        outbox.mode(Delivery.PUSH);
        frame(3, position(3));
        assertThat(sent()).containsExactly("position 2", "position 3");
    }

    @Test
    void pull_overflow_isCountedAndTold() {
        pull();
        for (int tick = 0; tick < Outbox.MAX_DATA + 7; tick++) {
            frame(tick, position(tick));
        }
        ask();
        List<String> sent = sent();
        assertThat(sent).hasSize(Outbox.MAX_DATA + 2).endsWith("position 1023", "SYNCH 2 7");
        ask();
        frame(2000, position(1));
        assertThat(sent()).containsExactly("ACK 4", "position 1", "SYNCH 1 0");
    }

    @Test
    void push_toAClientThatDoesNotRead_keepsABoundedNumber_orTheNewestByARule() {
        push();
        for (boolean replaces : new boolean[] {false, true}) {
            for (int tick = 0; tick < 5000; tick++) {
                frame(tick, position(tick));
            }
            assertThat(outbox.dropped()).isEqualTo(5000 - Outbox.MAX_DATA);
            if (replaces) {
                assertThat(sent()).containsExactly("position 4999");
            } else {
                assertThat(sent()).hasSize(1 + Outbox.MAX_DATA);
                rule(-1, 1, -1, ReplaceRule.REPLACE);
            }
        }
    }

    @Test
    void rules_replaceAndIgnore_theNewestCounts() {
        pull();
        rule(-1, 1, -1, ReplaceRule.REPLACE);
        frame(0, position(0), sonar());
        frame(1, position(1), sonar());
        ask();
        assertThat(sent()).containsExactly("ACK 4", "position 1", "sonar", "SYNCH 1 0");
        rule(5, 1, 1, ReplaceRule.IGNORE);
        ask();
        frame(2, position(2), sonar());
        assertThat(sent()).containsExactly("ACK 4", "position 2", "SYNCH 1 0");
        rule(-1, 1, -1, ReplaceRule.ACCEPT);
        ask();
        frame(3, position(3), sonar());
        assertThat(sent()).containsExactly("ACK 4", "position 3", "sonar", "SYNCH 1 0");
    }

    @Test
    void pull_frameOfWhichNothingIsLeft_isNotSent_andNeedsNoAnswer() {
        var unanswerable = new ArrayList<Long>();
        outbox.onEmptyFrame(unanswerable::add);
        pull();
        rule(-1, -1, -1, ReplaceRule.IGNORE);
        frame(0, position(0));
        assertThat(unanswerable).as("the client may still answer").isEmpty();
        assertThat(ask()).as("answered").isZero();
        assertThat(sent()).containsExactly("ACK 4");
        frame(1, position(1));
        frame(2, position(2));
        assertThat(sent()).isEmpty();
        assertThat(unanswerable).containsExactly(1L, 2L);
        rule(-1, -1, -1, ReplaceRule.ACCEPT);
        frame(3, position(3));
        assertThat(sent()).containsExactly("position 3", "SYNCH 1 0");
        assertThat(unanswerable).hasSize(2);
    }

    @Test
    void pull_frameOfADeviceThatIsNotSubscribed_isNotSent_andNeedsNoAnswer() {
        var unanswerable = new ArrayList<Long>();
        outbox.onEmptyFrame(unanswerable::add);
        push();
        outbox.mode(Delivery.PULL);
        ask();
        sent();
        frame(0, sonar());
        assertThat(sent()).isEmpty();
        assertThat(unanswerable).containsExactly(0L);
    }

    @Test
    void frame_doesNotWait_whileAnotherThreadIsBusyWithTheOutbox() throws InterruptedException {
        push();
        var busy = new CountDownLatch(1);
        var goOn = new CountDownLatch(1);
        var slow = new AbstractList<DeviceDataMessage>() {
            @Override
            public DeviceDataMessage get(int index) {
                busy.countDown();
                try {
                    goOn.await();
                } catch (InterruptedException e) {
                    throw new AssertionError(e);
                }
                return position(0);
            }

            @Override
            public int size() {
                return 1;
            }
        };
        Thread other = Thread.ofPlatform().daemon().start(() -> outbox.frame(0, 0, slow));
        busy.await();
        frame(1, position(1));
        frame(2, position(2));
        assertThat(goOn.getCount()).as("the other thread still has the lock").isEqualTo(1);
        goOn.countDown();
        other.join();
        assertThat(sent()).containsExactly("ACK 3", "position 0", "position 1", "position 2");
    }

    @Test
    void unsubscribed_takesItsDataOut() {
        pull();
        frame(0, position(0), sonar());
        outbox.unsubscribed(SONAR, reply(3));
        frame(1, position(1), sonar());
        ask();
        assertThat(sent()).containsExactly("position 0", "ACK 3", "ACK 4", "position 1", "SYNCH 1 0");
    }

    @Test
    void corked_keepsEverythingBack() throws InterruptedException {
        outbox.cork();
        outbox.reply(reply(3));
        var taken = new CountDownLatch(1);
        Thread taker = start(() -> {
            outbox.take();
            taken.countDown();
        });
        frame(0, position(0));
        assertThat(taken.getCount()).isEqualTo(1);
        outbox.uncork();
        taken.await();
        taker.join();
    }

    @Test
    void manyRepliesUnread_makeTheReaderWait_untilTheyAreTaken() throws InterruptedException {
        for (int i = 0; i <= Outbox.MAX_REPLY_BYTES / Header.BYTES; i++) {
            outbox.reply(reply(1));
        }
        Thread reader = start(outbox::awaitRoom);
        while (reader.getState() != Thread.State.WAITING) {
            assertThat(reader.isAlive()).as("the reader waits").isTrue();
            Thread.onSpinWait();
        }
        outbox.take();
        reader.join();
    }

    @Test
    void closed_endsEveryWaiting() throws InterruptedException {
        outbox.close();
        assertThat(outbox.take()).isNull();
        assertThat(outbox.awaitRoom()).isFalse();
    }

    @Test
    void subscription_isConfirmed_whenTheDevicesKnowOfIt() throws InterruptedException {
        var ranger = new ScriptedServer(Interfaces.RANGER);
        var handler = new ClientMessageHandler(
                "test", ranger, outbox, 1, 2, new TcpServer.Shared(TcpServer.Settings.ofMachine(1), Clock.system()));
        handler.handle(Hex.message(RawClient.bytes(new PlayerRequest.DataMode(Delivery.PULL))));
        outbox.take();
        var seen = new ArrayList<Thread.State>();
        ranger.whileSubscribing = () -> {
            Thread taker = start(outbox::take);
            while (taker.getState() != Thread.State.WAITING && taker.getState() != Thread.State.TERMINATED) {
                Thread.onSpinWait();
            }
            seen.add(taker.getState());
        };
        handler.handle(Hex.message(RawClient.bytes(RawClient.access(Interfaces.RANGER, PlayerRequest.OPEN))));
        assertThat(seen).as("the thread that writes to the client").containsExactly(Thread.State.WAITING);
    }
}
