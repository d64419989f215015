"""Prints what is in an MCAP file, and checks its checksums.

    pip install mcap
    python mcap_summary.py out/run.mcap
"""
import json
import sys

from mcap.reader import make_reader


def main(path):
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        summary = reader.get_summary()
        statistics = summary.statistics
        print(f"{statistics.message_count} messages in {statistics.chunk_count} chunks, "
              f"{statistics.message_start_time / 1e9} s to {statistics.message_end_time / 1e9} s")
        for entry in reader.iter_metadata():
            print(entry.name, json.dumps(entry.metadata, sort_keys=True))
        counts = {channel: 0 for channel in summary.channels}
        for schema, channel, message in reader.iter_messages():
            fields = json.loads(message.data)
            missing = [name for name in json.loads(schema.data)["required"] if name not in fields]
            if missing:
                sys.exit(f"a message on {channel.topic} has no {', '.join(missing)}")
            counts[channel.id] += 1
        if counts != {**counts, **statistics.channel_message_counts}:
            sys.exit(f"counted {counts}, but the file says {statistics.channel_message_counts}")
        for channel in sorted(summary.channels.values(), key=lambda each: each.id):
            schema = summary.schemas[channel.schema_id]
            print(f"{counts[channel.id]:6} {channel.topic} {schema.name}")


if __name__ == "__main__":
    main(sys.argv[1])
