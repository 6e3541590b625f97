using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Runtime.CompilerServices;
using System.Text.RegularExpressions;

namespace LagSim.Tests.Architecture;

/// <summary>How large types are: lines are counted in the source, fields in what was compiled.</summary>
internal static partial class TypeSizes
{
    private const BindingFlags OwnInstance = BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic | BindingFlags.DeclaredOnly;

    /// <summary>The lines of every type that is not nested, of all its parts together. What is nested in it counts as its own; so do its comment and attributes.</summary>
    /// <remarks>The formatter holds that a declaration begins in the first column, and that nothing else within a type does.</remarks>
    internal static Dictionary<string, int> Lines(IEnumerable<string> files)
    {
        Dictionary<string, int> sizes = [];
        foreach (string file in files)
        {
            string space = "";
            string? open = null;
            int began = -1;
            int comments = -1;
            bool isOpened = false;
            string[] lines = File.ReadAllLines(file);
            for (int i = 0; i < lines.Length; i++)
            {
                string line = lines[i];
                if (NamespaceLine().Match(line) is { Success: true } found)
                {
                    space = found.Groups[1].Value;
                }
                else if (line.StartsWith("///", StringComparison.Ordinal) || line.StartsWith('['))
                {
                    comments = comments < 0 ? i : comments;
                }
                else if (open is null && Declaration().Match(line) is { Success: true } type)
                {
                    string arity = type.Groups[2].Success ? "`" + (type.Groups[2].Value.Count(letter => letter == ',') + 1) : "";
                    open = $"{space}.{type.Groups[1].Value}{arity}";
                    began = comments < 0 ? i : comments;
                    comments = -1;
                    isOpened = false;
                }

                isOpened |= line == "{";
                if (open is not null && (line == "}" || !isOpened && line.EndsWith(';')))
                {
                    sizes[open] = sizes.GetValueOrDefault(open) + i - began + 1;
                    open = null;
                }
            }
        }

        return sizes;
    }

    /// <summary>The instance fields of a type itself. The field behind a property counts, the one behind an event does not.</summary>
    internal static int Fields(Type type) => type.GetFields(OwnInstance).Count(field => type.GetEvent(field.Name, OwnInstance) is null);

    /// <summary>Every type that somebody wrote, nested ones too.</summary>
    internal static IEnumerable<Type> Written(Assembly assembly) => assembly.GetTypes()
        .Where(type => type.Namespace?.StartsWith("LagSim", StringComparison.Ordinal) == true)
        .Where(type => !type.FullName!.Contains('<', StringComparison.Ordinal) && !type.IsDefined(typeof(CompilerGeneratedAttribute)));

    [GeneratedRegex(@"^namespace ([\w.]+);")]
    private static partial Regex NamespaceLine();

    [GeneratedRegex(
        @"^(?:(?:public|internal|file|sealed|static|abstract|readonly|ref|unsafe|partial) )*"
        + @"(?:record (?:struct|class)|class|struct|interface|enum|record|delegate [\w<>?\[\], .]+?) (\w+)(?:<([^>]+)>)?")]
    private static partial Regex Declaration();
}
