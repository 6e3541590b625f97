using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using LagSim.Tests.Api;
using Xunit;

namespace LagSim.Tests.Architecture;

/// <summary>No type of the source is large, but for those in <see cref="LargeTypes"/>, each with a reason.</summary>
public sealed class SizeTests
{
    private const int MaxLines = 400;
    private const int MaxFields = 15;

    private static readonly string[] Files = Directory.EnumerateFiles(Path.Combine(RepositoryRoot.Path, "src"), "*.cs", SearchOption.AllDirectories)
        .Where(file => !file.Split(Path.DirectorySeparatorChar).Any(part => part is "bin" or "obj"))
        .ToArray();

    [Fact]
    public void Types_AreSmall_OrListedWithAReason()
    {
        string[] wrong = Wrong(LargeTypes.All);
        Assert.True(wrong.Length == 0, string.Join("\n", wrong));
    }

    [Fact]
    public void Types_OfWhichALargeOneIsNotListed_AreSeenToFail()
    {
        foreach (LargeType large in LargeTypes.All)
        {
            Assert.StartsWith(large.Type + " has ", Assert.Single(Wrong(LargeTypes.All.Where(other => other != large))), StringComparison.Ordinal);
        }
    }

    [Fact]
    public void List_WithAnEntryThatIsNotNeeded_IsSeenToFail() => Assert.Equal(
        ["LagSim.Time.SimTime is not large, or not there any more. Delete its entry."],
        Wrong(LargeTypes.All.Append(new LargeType("LagSim.Time.SimTime", "none"))));

    [Fact]
    public void Types_OverEvenWhatAReasonIsGoodFor_AreSeenToFail()
    {
        LargeType[] tighter = LargeTypes.All.Select(large => large with { MaxLines = 10 }).ToArray();
        Assert.Equal(LargeTypes.All.Length, Wrong(tighter).Length);
    }

    [Fact]
    public void Lines_AreCountedOfEveryType()
    {
        Dictionary<string, int> lines = TypeSizes.Lines(Files);
        string[] uncounted = SourceAssemblies.All.SelectMany(TypeSizes.Written).Where(type => !type.IsNested)
            .Select(type => type.FullName!).Where(type => !lines.ContainsKey(type)).ToArray();
        Assert.Empty(uncounted);

        // Few lines are outside types: usings, the namespace, blank ones between.
        int all = Files.Sum(file => File.ReadLines(file).Count(line => line.Length > 0 && !line.StartsWith("using ", StringComparison.Ordinal)
            && !line.StartsWith("namespace ", StringComparison.Ordinal) && line[0] is not ('#' or '/' or '[')));
        Assert.True(lines.Values.Sum() >= all, $"Only {lines.Values.Sum()} of {all} lines of code were counted as some type's.");
    }

    [Fact]
    public void Parts_OfOneType_AreCountedTogether()
    {
        string folder = Directory.CreateTempSubdirectory("sizes").FullName;
        try
        {
            string first = Path.Combine(folder, "Large.cs");
            string second = Path.Combine(folder, "Large.Rest.cs");
            File.WriteAllLines(first, ["using System;", "", "namespace N;", "", "/// <summary>A.</summary>", "public sealed partial class Large", "{", "    int a;", "}"]);
            File.WriteAllLines(second, ["namespace N;", "", "partial class Large", "{", "    class Inner", "    {", "    }", "}", "", "record Small<T>(T A);"]);
            Assert.Equal([("N.Large", 11), ("N.Small`1", 1)], TypeSizes.Lines([first, second]).Select(size => (size.Key, size.Value)));
        }
        finally
        {
            Directory.Delete(folder, true);
        }
    }

    [Fact]
    public void Fields_BehindProperties_Count_AndThoseBehindEventsDoNot() => Assert.Equal(3, TypeSizes.Fields(typeof(FieldSample)));

    private static string[] Wrong(IEnumerable<LargeType> allowed)
    {
        LargeType[] list = allowed.ToArray();
        Dictionary<string, int> lines = TypeSizes.Lines(Files);
        Dictionary<string, string> large = [];
        List<string> wrong = [];
        foreach ((string type, int count) in lines.Where(size => size.Value > MaxLines))
        {
            large[type] = $"{type} has {count} lines, more than {MaxLines}";
        }

        foreach (Type type in SourceAssemblies.All.SelectMany(TypeSizes.Written).Where(type => TypeSizes.Fields(type) > MaxFields))
        {
            large[type.FullName!] = (large.TryGetValue(type.FullName!, out string? also) ? also + " and " : $"{type.FullName} has ")
                + $"{TypeSizes.Fields(type)} fields, more than {MaxFields}";
        }

        foreach (LargeType entry in list)
        {
            int count = lines.GetValueOrDefault(entry.Type);
            if (count > entry.MaxLines)
            {
                wrong.Add($"{entry.Type} has {count} lines, more than the {entry.MaxLines} that its reason is good for.");
            }

            if (entry.MaxLines > LargeType.UsualMaxLines && count <= LargeType.UsualMaxLines)
            {
                wrong.Add($"{entry.Type} has {count} lines and need not be allowed {entry.MaxLines}.");
            }
        }

        HashSet<string> listed = list.Select(entry => entry.Type).ToHashSet();
        wrong.AddRange(large.Where(one => !listed.Contains(one.Key)).Select(one => one.Value + ". Split it, or list it in LargeTypes with the reason."));
        wrong.AddRange(listed.Where(type => !large.ContainsKey(type)).Select(type => $"{type} is not large, or not there any more. Delete its entry."));
        return [.. wrong.Order(StringComparer.Ordinal)];
    }

    private sealed class FieldSample(int captured)
    {
#pragma warning disable CS0067
        internal event Action? Happened;
#pragma warning restore CS0067

        internal Action? Handler { get; set; }

        internal int Property { get; } = 1;

        internal int Sum => captured + Property;
    }
}
