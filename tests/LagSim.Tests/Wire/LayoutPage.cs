using System;
using System.Collections.Generic;
using System.Globalization;
using System.IO;
using System.Linq;
using System.Text;
using LagSim.Events;
using LagSim.Net.Wire;
using LagSim.Scenes;
using LagSim.Tests.Api;
using LagSim.Time;

namespace LagSim.Tests.Wire;

/// <summary>A page of docs that lays out bytes in tables of type, field and value; and bytes written from its tables, without the library.</summary>
internal static class LayoutPage
{
    internal static string[] Read(string name) => File.ReadAllLines(Path.Combine(RepositoryRoot.Path, "docs", name));

    /// <summary>A row of a table of fields: type, field, value.</summary>
    internal static bool IsField(string[] page, int line)
    {
        int head = line;
        while (head > 0 && page[head].StartsWith('|'))
        {
            head--;
        }

        return line > head + 2 && page[head + 1].StartsWith("| type | field |", StringComparison.Ordinal);
    }

    /// <summary>The fields under the heading that begins like this.</summary>
    internal static LayoutRow[] Table(string[] page, string heading)
    {
        int at = Array.FindIndex(page, line => line.StartsWith(heading, StringComparison.Ordinal)) + 1;
        int end = Array.FindIndex(page, at, line => line.StartsWith('#'));
        return Enumerable.Range(at, (end < 0 ? page.Length : end) - at).Where(line => IsField(page, line))
            .Select(line => page[line].Split('|', 5)).Select(cells => new LayoutRow(cells[1].Trim(), cells[2].Trim(), cells[3].Trim())).ToArray();
    }

    internal static Dictionary<string, object> Values(params (string Field, object Value)[] values) => values.ToDictionary(v => v.Field, v => v.Value);

    internal static void Write(Stream to, IEnumerable<LayoutRow> rows, Dictionary<string, object> values)
    {
        foreach (LayoutRow row in rows)
        {
            to.Write(Bytes(row.Type, values[row.Field]));
        }
    }

    /// <summary>Writes a table in which a row that says "then for each:" is followed by the rows of what there are several of.</summary>
    internal static void Write(
        Stream to, LayoutRow[] rows, Dictionary<string, object> head, Dictionary<string, (string Prefix, IEnumerable<Dictionary<string, object>> Items)> lists)
    {
        for (int i = 0; i < rows.Length; i++)
        {
            Write(to, [rows[i]], head);
            if (rows[i].Value.EndsWith("then for each:", StringComparison.Ordinal))
            {
                (string prefix, IEnumerable<Dictionary<string, object>> items) = lists[rows[i].Field];
                LayoutRow[] each = rows.Skip(i + 1).TakeWhile(row => row.Field.StartsWith(prefix, StringComparison.Ordinal)).ToArray();
                foreach (Dictionary<string, object> item in items)
                {
                    Write(to, each, item);
                }

                i += each.Length;
            }
        }
    }

    internal static byte[] Bytes(string type, object value)
    {
        switch (type)
        {
            case "u8":
                return [Convert.ToByte(value, CultureInfo.InvariantCulture)];
            case "i8":
                return [unchecked((byte)Convert.ToSByte(value, CultureInfo.InvariantCulture))];
            case "u16":
                return BitConverter.GetBytes(Convert.ToUInt16(value, CultureInfo.InvariantCulture));
            case "u32":
                return BitConverter.GetBytes(Convert.ToUInt32(value, CultureInfo.InvariantCulture));
            case "u64":
                return BitConverter.GetBytes((ulong)value);
            case "i32":
                return BitConverter.GetBytes((int)value);
            case "i64":
                return BitConverter.GetBytes((long)value);
            case "f64":
                return BitConverter.GetBytes((double)value + 0.0);
            case "vector":
                Vector3D v = (Vector3D)value;
                return [.. Bytes("f64", v.X), .. Bytes("f64", v.Y), .. Bytes("f64", v.Z)];
            case "bits":
                Vector3D b = (Vector3D)value;
                return [.. BitConverter.GetBytes(b.X), .. BitConverter.GetBytes(b.Y), .. BitConverter.GetBytes(b.Z)];
            case "time" or "time?" or "ticks":
                return BitConverter.GetBytes(((SimTime)value).Ticks);
            case "text":
                byte[] utf8 = Encoding.UTF8.GetBytes((string)value);
                return [(byte)utf8.Length, .. utf8];
            case "length":
                int length = (int)value;
                return length < 128 ? [(byte)length] : [(byte)(128 + (length % 128)), .. Bytes("length", length / 128)];
            case "planes":
                return ((int[])value).SelectMany(BitConverter.GetBytes).ToArray();
            case "step?":
                return ((long[])value).SelectMany(BitConverter.GetBytes).ToArray();
            case "dense" or "spin":
                return ((Vector3D[])value).SelectMany(c => Bytes("bits", c)).ToArray();
            case "hold":
                return ((Hold Hold, Vector3D Cubic)?)value is var (hold, cubic) ? [.. Bytes("bits", cubic), hold.Peer, .. Bytes("bits", hold.Offset), .. Bytes("ticks", hold.KeyframeTime)] : [];
            case "member":
                return ((SimTime Centre, SimTime Still, int Contacts)?)value is var (centre, still, contacts)
                    ? [.. Bytes("ticks", centre), .. Bytes("ticks", still), .. Bytes("u16", contacts)] : [];
            case "bytes" or "8 bytes" or "token" or "entry" or "contacts" or "sensors" or "players" or "strength" or "busy":
                return (byte[])value;
            case "spec":
                BodySpec spec = (BodySpec)value;
                return
                [
                    .. Bytes("f64", spec.Radius), .. Bytes("f64", spec.Mass), .. Bytes("f64", spec.Restitution),
                    (byte)spec.Flight, .. BitConverter.GetBytes(spec.Step.Ticks),
                    .. BitConverter.GetBytes(spec.Forces.Mask), .. Bytes("f64", spec.Tolerance),
                    .. Bytes("f64", spec.Friction), .. Bytes("f64", spec.RollingResistance),
                    .. Bytes("filter", spec.Filter), .. BitConverter.GetBytes(spec.Tag),
                ];
            case "filter":
                return value is CollisionFilter filter ? [.. BitConverter.GetBytes(filter.Category), .. BitConverter.GetBytes(filter.Mask)] : [];
            case "event":
                ExternalEvent what = (ExternalEvent)value;
                byte[] bytes = new byte[EventFormat.EncodedLength(what)];
                WireWriter writer = new(bytes);
                EventFormat.Write(ref writer, what);
                return bytes;
            default:
                throw new NotSupportedException($"The page has a type '{type}' that no list of it explains.");
        }
    }
}

/// <summary>A row of a table of fields.</summary>
internal readonly record struct LayoutRow(string Type, string Field, string Value);
