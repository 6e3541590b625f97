using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;

namespace LagSim.Tests.Protection;

/// <summary>
/// All numbers that an object of the protection holds in managed memory, itself or by what it refers to, as they were and as they are now: what
/// is still there after it was wiped.
/// </summary>
internal sealed class SecretWords
{
    private readonly List<(string Path, Func<uint> Read, uint Before)> words = [];
    private readonly HashSet<object> seen = new(ReferenceEqualityComparer.Instance);

    /// <summary>Notes what an object holds now, besides what was noted before.</summary>
    internal void Note(object? holder, string path) => Walk(holder, path);

    /// <summary>Where the same is still held, by fields; but for those that are no secret.</summary>
    /// <param name="other">
    /// What another object holds that went the same way with other keys: what is equal there is a constant.
    /// </param>
    /// <param name="isPublic">Whether a field is no secret, by its path.</param>
    internal string[] Left(SecretWords other, Func<string, bool> isPublic)
    {
        ILookup<string, uint> constant = other.words.ToLookup(word => word.Path, word => word.Before);
        return [.. words.Where(word => word.Before > byte.MaxValue && word.Read() == word.Before && !isPublic(word.Path) && !constant[word.Path].Contains(word.Before))
            .Select(word => word.Path).Distinct()];
    }

    private void Walk(object? holder, string path)
    {
        if (holder is null or string or Delegate or Pointer || !seen.Add(holder))
        {
            return;
        }

        if (holder is Array array)
        {
            Take(array, path);
            return;
        }

        if (!holder.GetType().Assembly.GetName().Name!.StartsWith("LagSim", StringComparison.Ordinal) && holder.GetType().Namespace?.StartsWith("Org.BouncyCastle", StringComparison.Ordinal) != true)
        {
            return; // libsodium's keys are not in managed memory
        }

        for (Type? type = holder.GetType(); type is not null && type != typeof(object); type = type.BaseType)
        {
            foreach (FieldInfo field in type.GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly))
            {
                if (field.FieldType == typeof(uint) || field.FieldType == typeof(int))
                {
                    Take($"{path}.{field.Name}", () => unchecked((uint)Convert.ToInt64(field.GetValue(holder), null)));
                }
                else if (!field.FieldType.IsValueType)
                {
                    Walk(field.GetValue(holder), $"{path}.{field.Name}");
                }
            }
        }
    }

    private void Take(Array array, string path)
    {
        bool isOfNumbers = array is byte[] or uint[] or int[];
        for (int n = 0; isOfNumbers && n < Buffer.ByteLength(array) / sizeof(uint); n++)
        {
            int at = n;
            Take(path, () => MemoryMarshal.Cast<byte, uint>(MemoryMarshal.CreateSpan(ref MemoryMarshal.GetArrayDataReference(array), Buffer.ByteLength(array)))[at]);
        }
    }

    private void Take(string path, Func<uint> read) => words.Add((path, read, read()));
}
