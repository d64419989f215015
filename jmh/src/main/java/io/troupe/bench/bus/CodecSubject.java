package io.troupe.bench.bus;

import com.fasterxml.jackson.annotation.JsonTypeInfo;
import io.troupe.bus.internal.RecordCodec;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Supplier;
import org.jspecify.annotations.Nullable;
import tools.jackson.dataformat.cbor.CBORMapper;

/** One codec, and values to encode and decode. */
final class CodecSubject {
    static final int BATCH = 256;
    private static final int VALUES = 64; // different ones, so that nothing is computed in advance

    private final Codec codec;
    private final Samples<SampleValues.Sonar> sonars;
    private final Samples<SampleValues.Velocity> velocities;
    private final Samples<SampleValues.Report> reports;

    private @Nullable Object kept; // or the compiler would leave out the work

    /** Encodes values of one type, and decodes them. */
    private interface Coding<T extends Record> {
        byte[] encode(T value);

        T decode(byte[] bytes);
    }

    private interface Codec {
        <T extends Record> Coding<T> of(Class<T> type);
    }

    private record Samples<T extends Record>(Coding<T> coding, List<T> values, List<byte[]> encoded) {}

    private CodecSubject(Codec codec, long seed) {
        this.codec = codec;
        var random = new SampleValues(seed);
        sonars = samples(SampleValues.Sonar.class, random::sonar);
        velocities = samples(SampleValues.Velocity.class, random::velocity);
        reports = samples(SampleValues.Report.class, random::report);
    }

    static CodecSubject of(BusContender contender, long seed) {
        return switch (contender) {
            case TROUPE -> new CodecSubject(new Ours(), seed);
            case JACKSON -> new CodecSubject(new Jackson(), seed);
            case ACTOR, RAW -> throw new IllegalArgumentException(contender.label() + " has no codec");
        };
    }

    private <T extends Record> Samples<T> samples(Class<T> type, Supplier<T> value) {
        Coding<T> coding = codec.of(type);
        List<T> values = new ArrayList<>();
        List<byte[]> encoded = new ArrayList<>();
        for (int i = 0; i < VALUES; i++) {
            T each = value.get();
            byte[] bytes = coding.encode(each);
            if (!coding.decode(bytes).equals(each)) {
                throw new IllegalStateException(each + " became " + coding.decode(bytes));
            }
            values.add(each);
            encoded.add(bytes);
        }
        return new Samples<>(coding, values, encoded);
    }

    /** The mean number of bytes of a value. */
    double encodedBytes(BusWorkload workload) {
        return samplesOf(workload).encoded.stream()
                .mapToInt(bytes -> bytes.length)
                .average()
                .orElseThrow();
    }

    private Samples<?> samplesOf(BusWorkload workload) {
        return switch (workload) {
            case ENCODE_SONAR, DECODE_SONAR -> sonars;
            case ENCODE_VELOCITY, DECODE_VELOCITY -> velocities;
            case ENCODE_REPORT, DECODE_REPORT -> reports;
            default -> throw new IllegalArgumentException(workload + " has no codec");
        };
    }

    /** Encodes or decodes {@value #BATCH} values. */
    void run(BusWorkload workload) {
        switch (workload) {
            case ENCODE_SONAR, ENCODE_VELOCITY, ENCODE_REPORT -> encode(samplesOf(workload));
            default -> decode(samplesOf(workload));
        }
    }

    private <T extends Record> void encode(Samples<T> samples) {
        for (int i = 0; i < BATCH; i++) {
            kept = samples.coding.encode(samples.values.get(i % VALUES));
        }
    }

    private void decode(Samples<?> samples) {
        for (int i = 0; i < BATCH; i++) {
            kept = samples.coding.decode(samples.encoded.get(i % VALUES));
        }
    }

    /** The last result. */
    @Nullable
    Object kept() {
        return kept;
    }

    private static final class Ours implements Codec {
        private final RecordCodec codec = new RecordCodec();

        @Override
        public <T extends Record> Coding<T> of(Class<T> type) {
            return new Coding<>() {
                @Override
                public byte[] encode(T value) {
                    return codec.encode(value);
                }

                @Override
                public T decode(byte[] bytes) {
                    return codec.decode(bytes, type);
                }
            };
        }
    }

    /** With its defaults; the sealed interface has the annotation that it needs. */
    private static final class Jackson implements Codec {
        @JsonTypeInfo(use = JsonTypeInfo.Id.SIMPLE_NAME)
        private interface NamedClass {}

        private final CBORMapper mapper = CBORMapper.builder()
                .addMixIn(SampleValues.Activity.class, NamedClass.class)
                .build();

        @Override
        public <T extends Record> Coding<T> of(Class<T> type) {
            var writer = mapper.writerFor(type);
            var reader = mapper.readerFor(type);
            return new Coding<>() {
                @Override
                public byte[] encode(T value) {
                    return writer.writeValueAsBytes(value);
                }

                @Override
                public T decode(byte[] bytes) {
                    return reader.readValue(bytes);
                }
            };
        }
    }
}
