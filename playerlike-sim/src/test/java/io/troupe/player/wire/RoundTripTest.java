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
                Content content = DataCodec.encode(message.data());
                assertThat(content.payload().length % 4).isZero();
                assertThat(DataCodec.decode(message.from().interfaceCode(), content.subtype(), content.payload()))
                        .contains(message.data());
                WireMessage whole = WireMessage.of(
                        message.from(), MessageType.DATA, content.subtype(), message.timeSeconds(), content.payload());
                assertThat(Hex.message(whole.bytes()).header()).isEqualTo(whole.header());
            }
        });
    }

    @Test
    void commands_ofEveryKind_comeBack() throws WireException {
        forSeeds(messages -> {
            for (var command : messages.positionCommands()) {
                Content content = CommandCodec.encode(command);
                assertThat(CommandCodec.decode(4, content.subtype(), content.payload()))
                        .contains(command);
            }
        });
        for (var command : List.of(new DeviceCommand.Pause(), new DeviceCommand.Reset(), new DeviceCommand.Save())) {
            Content content = CommandCodec.encode(command);
            assertThat(CommandCodec.decode(31, content.subtype(), content.payload()))
                    .contains(command);
        }
    }

    @Test
    void requests_ofEveryKind_comeBack() throws WireException {
        forSeeds(messages -> {
            for (var asked : messages.requests()) {
                Content content = RequestCodec.encode(asked.interfaceCode(), asked.request());
                assertThat(RequestCodec.decode(asked.interfaceCode(), content.subtype(), content.payload()))
                        .isEqualTo(asked.request());
            }
        });
    }

    @Test
    void replies_ofEveryKind_comeBack() throws WireException {
        forSeeds(messages -> {
            for (var answered : messages.replies()) {
                assertThat(ReplyCodec.decode(
                                answered.interfaceCode(),
                                ReplyCodec.type(answered.reply()),
                                answered.subtype(),
                                ReplyCodec.encode(answered.reply())))
                        .isEqualTo(answered.reply());
            }
        });
    }

    @Test
    void playerRequests_ofEveryKind_comeBack() throws WireException {
        forSeeds(messages -> {
            for (var request : messages.playerRequests()) {
                Content content = PlayerDeviceCodec.encode(request);
                assertThat(PlayerDeviceCodec.request(content.subtype(), content.payload()))
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
                        () -> assertThat(PlayerDeviceCodec.reply(
                                        MessageType.ACK, at + 1, PlayerDeviceCodec.encode(replies.get(at))))
                                .isEqualTo(replies.get(at))))
                .toList();
    }
}
