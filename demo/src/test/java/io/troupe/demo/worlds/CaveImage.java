package io.troupe.demo.worlds;

import java.awt.image.BufferedImage;
import java.util.ArrayDeque;
import java.util.List;
import java.util.Random;

/**
 * Draws {@code cave.png}: random rock, smoothed by giving each pixel the majority value of its neighbours, without
 * closed cavities.
 */
final class CaveImage {
    private static final int SIDE = 400;
    private static final int RIM = 6;
    private static final int REACH = 5;
    private static final int ROUNDS = 14;
    private static final long SEED = 11;

    private final boolean[][] rock = new boolean[SIDE][SIDE];

    private CaveImage() {}

    private interface Rule {
        boolean isRock(int x, int y);
    }

    private static CaveImage of(Rule rule) {
        var cave = new CaveImage();
        for (int y = 0; y < SIDE; y++) {
            for (int x = 0; x < SIDE; x++) {
                cave.rock[y][x] = rule.isRock(x, y);
            }
        }
        return cave;
    }

    private boolean isRock(int x, int y) {
        return x < RIM || y < RIM || x >= SIDE - RIM || y >= SIDE - RIM || rock[y][x];
    }

    private boolean isAmongRock(int x, int y) {
        int around = 0;
        for (int dy = -REACH; dy <= REACH; dy++) {
            for (int dx = -REACH; dx <= REACH; dx++) {
                around += isRock(x + dx, y + dy) ? 1 : 0;
            }
        }
        return 2 * around > (2 * REACH + 1) * (2 * REACH + 1);
    }

    static BufferedImage draw() {
        var random = new Random(SEED);
        var cave = of((x, y) -> StrictMath.hypot(x - SIDE / 2.0, y - SIDE / 2.0) >= 40 && random.nextInt(1000) < 482);
        for (int round = 0; round < ROUNDS; round++) {
            cave = of(cave::isAmongRock);
        }
        var closed = of((x, y) -> true);
        var front = new ArrayDeque<>(List.of(new int[] {SIDE / 2, SIDE / 2}));
        while (!front.isEmpty()) {
            int x = front.peek()[0];
            int y = front.remove()[1];
            if (!cave.isRock(x, y) && closed.rock[y][x]) {
                closed.rock[y][x] = false;
                front.addAll(List.of(
                        new int[] {x + 1, y}, new int[] {x - 1, y}, new int[] {x, y + 1}, new int[] {x, y - 1}));
            }
        }
        var image = new BufferedImage(SIDE, SIDE, BufferedImage.TYPE_BYTE_BINARY);
        for (int pixel = 0; pixel < SIDE * SIDE; pixel++) {
            boolean dark = closed.rock[pixel / SIDE][pixel % SIDE];
            image.setRGB(pixel % SIDE, pixel / SIDE, dark ? 0xff000000 : 0xffffffff);
        }
        return image;
    }
}
