package io.troupe.player.wire;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import java.util.Random;
import org.junit.jupiter.api.DynamicTest;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestFactory;

/** Encoding and decoding returns the same record, for random content of every message. */
class RoundTripTest {
    private static final int SEEDS = 300;

    private interface Law {
        void check(RandomMessages messages) throws WireException;
    }

    private static void forSeeds(Law law) throws WireException {
        for (long seed = 1; seed <= SEEDS; seed++) {
            try {
                law.check(new RandomMessages(new Random(seed)));
            } catch (WireException | AssertionError | RuntimeException e) {
                throw new AssertionError("seed " + seed + ": " + e.getMessage(), e);
            }
        }
    }

    @Test
    void data_ofEveryKind_comesBack() throws WireException {
        forSeeds(messages -> {
            for (var message : messages.data()) {
                Content content = DataMessages.encode(message.data());
                assertThat(content.payload().length % 4).isZero();
                assertThat(DataMessages.decode(message.from().interfaceCode(), content.subtype(), content.payload()))
                        .contains(message.data());
                Message whole = Message.of(
                        message.from(), MessageType.DATA, content.subtype(), message.timeSeconds(), content.payload());
                assertThat(Hex.message(whole.bytes()).header()).isEqualTo(whole.header());
            }
        });
    }

    @Test
    void commands_ofEveryKind_comeBack() throws WireException {
        forSeeds(messages -> {
            for (var command : messages.positionCommands()) {
                Content content = CommandMessages.encode(command);
                assertThat(CommandMessages.decode(4, content.subtype(), content.payload()))
                        .contains(command);
            }
        });
        for (var command : List.of(new DeviceCommand.Pause(), new DeviceCommand.Reset(), new DeviceCommand.Save())) {
            Content content = CommandMessages.encode(command);
            assertThat(CommandMessages.decode(31, content.subtype(), content.payload()))
                    .contains(command);
        }
    }

    @Test
    void requests_ofEveryKind_comeBack() throws WireException {
        forSeeds(messages -> {
            for (var asked : messages.requests()) {
                Content content = RequestMessages.encode(asked.interfaceCode(), asked.request());
                assertThat(RequestMessages.decode(asked.interfaceCode(), content.subtype(), content.payload()))
                        .isEqualTo(asked.request());
            }
        });
    }

    @Test
    void replies_ofEveryKind_comeBack() throws WireException {
        forSeeds(messages -> {
            for (var answered : messages.replies()) {
                assertThat(ReplyMessages.decode(
                                answered.interfaceCode(),
                                ReplyMessages.type(answered.reply()),
                                answered.subtype(),
                                ReplyMessages.encode(answered.reply())))
                        .isEqualTo(answered.reply());
            }
        });
    }

    @Test
    void playerRequests_ofEveryKind_comeBack() throws WireException {
        forSeeds(messages -> {
            for (var request : messages.playerRequests()) {
                Content content = PlayerMessages.encode(request);
                assertThat(PlayerMessages.request(content.subtype(), content.payload()))
                        .isEqualTo(request);
            }
        });
    }

    @TestFactory
    List<DynamicTest> playerReplies_comeBack() {
        var messages = new RandomMessages(new Random(1));
        var replies = List.<PlayerReply>of(
                new PlayerReply.DeviceList(messages.list(messages::address)),
                new PlayerReply.DriverInfo(messages.address(), messages.name()),
                new PlayerReply.Access(messages.address(), 2, messages.name()));
        return List.of(0, 1, 2).stream()
                .map(at -> DynamicTest.dynamicTest(
                        replies.get(at).toString(),
                        () -> assertThat(PlayerMessages.reply(
                                        MessageType.ACK, at + 1, PlayerMessages.encode(replies.get(at))))
                                .isEqualTo(replies.get(at))))
                .toList();
    }
}
